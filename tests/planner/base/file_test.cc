#include "planner/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "planner/base/error.h"

namespace regrasp {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A folder of its own for each test, gone afterwards.
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
  [[nodiscard]] std::ptrdiff_t FilesInFolder() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
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

TEST_F(FileTest, BytesComeBackAsWritten) {
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes += static_cast<char>(i * 7);
  const fs::path path = folder_ / "bytes";
  for (const std::string& written : {bytes, std::string(), std::string("x\0\r\n", 4)}) {
    WriteFile(path, written);
    EXPECT_EQ(ReadFile(path), written);
  }
  EXPECT_EQ(FilesInFolder(), 1) << "something was left aside";
}

TEST_F(FileTest, WhatCannotBeReadIsBadInput) {
  const auto message = [](const fs::path& path) {
    return MessageOf<InputError>([&] { static_cast<void>(ReadFile(path)); });
  };
  EXPECT_THAT(message(folder_ / "missing"), HasSubstr("missing: no such file"));
  EXPECT_THAT(message(folder_), HasSubstr("is a folder"));
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
              HasSubstr("larger than"));
  EXPECT_THAT(MessageOf<InputError>([] { static_cast<void>(ReadFile("/dev/zero")); }),
              HasSubstr("larger than"));
}

TEST_F(FileTest, WhatCannotBeWrittenIsAFailureOfTheEnvironment) {
  const auto message = [](const fs::path& path) {
    return MessageOf<EnvironmentError>([&] { WriteFile(path, "x"); });
  };
  EXPECT_THAT(message(folder_ / "missing" / "file"), HasSubstr("cannot be written"));
  EXPECT_THAT(message(folder_), HasSubstr("cannot be written"));
  fs::create_directories(folder_ / "occupied" / "inside");
  EXPECT_THAT(message(folder_ / "occupied"), HasSubstr("cannot be written"));
  EXPECT_EQ(FilesInFolder(), 1) << "something was left aside";
}

TEST_F(FileTest, AFullDiskIsAFailureAndLeavesTheOldFile) {
  EXPECT_THAT(MessageOf<EnvironmentError>([] { WriteFile("/dev/full/x", "x"); }),
              HasSubstr("cannot be written"));
  const fs::path path = folder_ / "kept";
  WriteFile(path, "old");
  fs::create_directory(folder_ / ("kept.tmp" + std::to_string(getpid())));
  EXPECT_THAT(MessageOf<EnvironmentError>([&] { WriteFile(path, "new"); }),
              HasSubstr("cannot be written"));
  EXPECT_EQ(ReadFile(path), "old");
}

TEST_F(FileTest, AReaderNeverSeesHalfAFile) {
  const fs::path path = folder_ / "whole";
  const std::string a(3'000'000, 'a'), b(2'000'000, 'b');
  WriteFile(path, a);
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int i = 0; i < 40; ++i) WriteFile(path, i % 2 == 0 ? b : a);
    done = true;
  });
  int reads = 0;
  do {
    const std::string seen = ReadFile(path);
    EXPECT_TRUE(seen == a || seen == b) << seen.size() << " bytes";
    ++reads;
  } while (!done);
  writer.join();
  EXPECT_GT(reads, 0);
  EXPECT_EQ(FilesInFolder(), 1);
}

TEST(Sha256, IsThatOfThePublishedVectors) {
  // FIPS 180-2, appendix B.
  EXPECT_EQ(Sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_F(FileTest, WhatAKilledWriterLeftIsKnownByItsName) {
  EXPECT_EQ(NameBesideAside("report.json.tmp123"), "report.json");
  EXPECT_EQ(NameBesideAside("a.tmp1.tmp22"), "a.tmp1");
  for (const char* name : {"report.json", "report.json.tmp", "report.json.tmp1x", "tmp12", ""}) {
    EXPECT_EQ(NameBesideAside(name), "") << name;
  }
}

}  // namespace
}  // namespace regrasp
