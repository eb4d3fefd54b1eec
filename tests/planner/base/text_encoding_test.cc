#include "planner/base/text_encoding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planner/base/error.h"
#include "planner/base/json.h"

namespace regrasp {
namespace text_encoding_test {

using ::testing::HasSubstr;
using namespace std::string_literals;

std::string Refusal(const std::string& bytes) {
  try {
    static_cast<void>(TextOf(bytes, "a.txt"));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(TextOf, SkipsTheMarkOfUtf8) {
  EXPECT_EQ(TextOf("\xEF\xBB\xBFv 0", "t"), "v 0");
  EXPECT_EQ(TextOf("\xEF\xBB\xBF", "t"), "");
}

TEST(TextOf, KeepsOtherBytes) {
  for (const std::string& text :
       {""s, "v"s, "\xEF\xBB"s, "caf\xE9"s, "ab\0cd"s, "\0\0\0\0"s, "[1]\0{"s, "\xEF\xBB x"s}) {
    EXPECT_EQ(TextOf(text, "t"), text);
  }
}

TEST(TextOf, RefusesWideEncodingsByName) {
  const std::string utf16 =
      "a.txt: text encoding: not supported, expected UTF-8, found UTF-16; help: save the file as "
      "UTF-8";
  EXPECT_EQ(Refusal("\xFF\xFEv\0"s), utf16);
  EXPECT_EQ(Refusal("\xFE\xFF\0v"s), utf16);
  EXPECT_EQ(Refusal("v\0 \0"s), utf16);
  EXPECT_EQ(Refusal("\0v\0 "s), utf16);
  EXPECT_EQ(Refusal("\xFF\xFE"s), utf16);
  EXPECT_THAT(Refusal("\xFF\xFE\0\0v\0\0\0"s), HasSubstr("found UTF-32"));
  EXPECT_THAT(Refusal("\0\0\xFE\xFF\0\0\0v"s), HasSubstr("found UTF-32"));
  EXPECT_THAT(Refusal("v\0\0\0 \0\0\0"s), HasSubstr("found UTF-32"));
  EXPECT_THAT(Refusal("\0\0\0v\0\0\0 "s), HasSubstr("found UTF-32"));
}

TEST(TextOf, JsonIsReadThroughIt) {
  EXPECT_EQ(ParseJson("\xEF\xBB\xBF[1]", "t").size(), 1U);
  try {
    static_cast<void>(ParseJson("{\0}\0"s, "plan.json"));
    ADD_FAILURE() << "UTF-16 was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("plan.json: text encoding: not supported"));
  }
}

}  // namespace text_encoding_test
}  // namespace regrasp
