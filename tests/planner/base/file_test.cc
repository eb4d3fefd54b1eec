#include "planner/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "planner/base/error.h"
#include "planner/base/json.h"

namespace regrasp {
namespace file_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Test with a folder of its own, which is removed afterwards.
class FileTest : public ::testing::Test {
 protected:
  FileTest()
      : folder_(fs::path(::testing::TempDir()) /
                ("regrasp_file_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~FileTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path folder_;
};

template <class Error>
std::string MessageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no such error";
}

TEST_F(FileTest, WhatCannotBeReadIsBadInput) {
  const auto message = [](const fs::path& path) {
    return MessageOf<InputError>([&] { static_cast<void>(ReadFile(path)); });
  };
  EXPECT_THAT(message(folder_ / "missing"), HasSubstr("missing: no such file"));
  EXPECT_THAT(message(folder_), HasSubstr("found a folder"));
  EXPECT_THAT(message(""), HasSubstr("no such file"));
  EXPECT_THAT(message(folder_ / "a" / "b"), HasSubstr("no such file"));
  EXPECT_THAT(message(std::string(5000, 'x')), HasSubstr("no such file"));
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THAT(message(folder_ / "file" / "below"), HasSubstr("no such file"));
}

TEST_F(FileTest, AFileThatIsTooLargeOrWithoutEndIsRefused) {
  std::ofstream(folder_ / "large");
  fs::resize_file(folder_ / "large", kMaxInputBytes + 1);  // sparse
  EXPECT_THAT(MessageOf<InputError>([&] { static_cast<void>(ReadFile(folder_ / "large")); }),
              HasSubstr("too large"));
  EXPECT_THAT(MessageOf<InputError>([] { static_cast<void>(ReadFile("/dev/zero")); }),
              HasSubstr("too large"));
}

TEST(Sha256, IsThatOfThePublishedVectors) {
  // FIPS 180-2, appendix B.
  EXPECT_EQ(Sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, IsTheSameOfBytesThatComeInPieces) {
  const std::string bytes(1'000'000, 'a');
  for (const std::size_t length : {std::size_t{1} << 20, std::size_t{4097}, std::size_t{64}}) {
    Sha256Sum sum;
    for (std::size_t begin = 0; begin < bytes.size(); begin += length) {
      sum.Add(std::string_view(bytes).substr(begin, length));
    }
    EXPECT_EQ(sum.Finish(), Sha256(bytes));
  }
  Sha256Sum other;
  other.Add("ab");
  EXPECT_NE(other.Finish(), Sha256("a"));
}

}  // namespace file_test

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
