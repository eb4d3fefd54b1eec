#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "planner/base/text_table.h"

namespace regrasp {
namespace utf8_test {

/// Encode a character, 0 to U+10FFFF.
std::string Encode(char32_t code) {
  const auto following = [&](int shift) {
    return static_cast<char>(0x80 | ((code >> shift) & 0x3F));
  };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xC0 | (code >> 6)), following(0)};
  if (code < 0x10000) {
    return {static_cast<char>(0xE0 | (code >> 12)), following(6), following(0)};
  }
  return {static_cast<char>(0xF0 | (code >> 18)), following(12), following(6), following(0)};
}

TEST(Utf8, EveryCharacterIsTakenWholeAndSurrogatesAreNone) {
  int taken = 0;
  for (char32_t code = 0; code <= 0x10FFFF; ++code) {
    const std::string text = Encode(code) + "z";
    std::string_view rest = text;
    const Utf8Character character = TakeCharacter(rest);
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    ASSERT_EQ(character.is_valid, !surrogate) << std::hex << static_cast<unsigned int>(code);
    if (surrogate) continue;
    ASSERT_EQ(character.code, code);
    ASSERT_EQ(rest, "z");
    ++taken;
  }
  EXPECT_EQ(taken, 0x110000 - 0x800);
}

TEST(Utf8, WhatIsTakenMakesUpTheText) {
  std::mt19937 random(3);
  int broken = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text(random() % 20, '\0');
    for (char& c : text) c = static_cast<char>(random() % 256);
    std::string all;
    for (std::string_view rest = text; !rest.empty();) {
      const Utf8Character character = TakeCharacter(rest);
      ASSERT_FALSE(character.bytes.empty());
      broken += !character.is_valid;
      all += character.bytes;
    }
    ASSERT_EQ(all, text);
  }
  EXPECT_GT(broken, 1000);
}

TEST(Utf8, BrokenBytesAreNoCharacters) {
  for (const std::string text :
       {"\x80", "\xBF", "\xC0\xBC", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF5", "\xFF", "\xE2\x82", "\xE2z", "\xF0\x9F\xA4"}) {
    std::string_view rest = text;
    EXPECT_FALSE(TakeCharacter(rest).is_valid) << testing::PrintToString(text);
  }
}

TEST(Utf8, OnlyWhatIsNotSeenIsInvisible) {
  for (const char32_t code : {0x00,   0x1B,   0x7F,   0x80,    0x85,     0x9B,   0x9F,   0xAD,
                              0x200B, 0x200E, 0x200F, 0x2028,  0x202A,   0x202E, 0x2066, 0x2069,
                              0xFEFF, 0xFFFE, 0xFFFF, 0x1FFFE, 0x10FFFF, 0xE0041}) {
    EXPECT_TRUE(IsInvisible(code)) << std::hex << static_cast<unsigned int>(code);
  }
  for (const char32_t code :
       {0x20, 0x7E, 0xA0, 0xFC, 0x3B8, 0x2009, 0x2026, 0x6F22, 0xFFFD, 0x1F90F}) {
    EXPECT_FALSE(IsInvisible(code)) << std::hex << static_cast<unsigned int>(code);
  }
}

}  // namespace utf8_test
}  // namespace regrasp
