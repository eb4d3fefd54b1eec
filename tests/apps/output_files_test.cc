#include "apps/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "planner/base/error.h"

namespace regrasp::apps {
namespace output_files_test {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Fixture with its own folder and some files, removed after each test.
class OutputFilesTest : public ::testing::Test {
 protected:
  OutputFilesTest()
      : folder_(fs::path(::testing::TempDir()) /
                ("regrasp_output_files_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "out");
    for (const char* name : {"plan", "other", "out/report"}) std::ofstream(folder_ / name) << name;
    fs::create_symlink("plan", folder_ / "link");
    fs::create_symlink("new", folder_ / "dangling");
    fs::create_symlink("out", folder_ / "out_link");
    fs::create_hard_link(folder_ / "plan", folder_ / "hard");
  }
  ~OutputFilesTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  [[nodiscard]] OutputFiles Files(const std::string& first, const std::string& second = "") const {
    OutputFiles outputs;
    outputs.Add("--first", folder_ / first);
    if (!second.empty()) outputs.Add("--second", folder_ / second);
    return outputs;
  }
  [[nodiscard]] OutputFiles AndFolder(OutputFiles outputs, const std::string& name) const {
    outputs.folders.push_back(
        {"--output", folder_ / name, [](const std::string& file) { return file == "report"; }});
    return outputs;
  }
  [[nodiscard]] std::string WhyNot(const std::string& input, const OutputFiles& outputs) const {
    try {
      CheckOutputsDiffer({{"--input", folder_ / input}}, outputs);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] static std::string WhyNotWritable(const OutputFiles& outputs) {
    try {
      CheckOutputsWritable(outputs);
    } catch (const EnvironmentError& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

TEST_F(OutputFilesTest, AnInputIsNoOutputByWhateverName) {
  for (const char* input : {"plan", "link", "hard", "out/../plan"}) {
    for (const char* output : {"plan", "link", "hard", "out_link/../plan"}) {
      EXPECT_THAT(
          WhyNot(input, Files(output)),
          AllOf(HasSubstr(output), HasSubstr("--first must not overwrite the file of --input")))
          << input;
    }
    EXPECT_EQ(WhyNot(input, Files("other", "new")), "") << input;
  }
  EXPECT_EQ(WhyNot("missing", Files("missing")), "");
}

TEST_F(OutputFilesTest, AFileInAnOutputFolderIsNoInputIfItMayBeReplaced) {
  EXPECT_THAT(WhyNot("out/report", AndFolder({}, "out")),
              HasSubstr("--output must not overwrite the file of --input"));
  EXPECT_THAT(WhyNot("out/report", AndFolder({}, "out_link")),
              HasSubstr("--output must not overwrite the file of --input"));
  fs::create_hard_link(folder_ / "plan", folder_ / "out" / "hard");
  EXPECT_EQ(WhyNot("plan", AndFolder({}, "out")), "");
  EXPECT_EQ(WhyNot("out/hard", AndFolder({}, "out")), "");
  fs::remove(folder_ / "out" / "report");
  fs::create_symlink("../plan", folder_ / "out" / "report");
  EXPECT_THAT(WhyNot("plan", AndFolder({}, "out")),
              HasSubstr("--output must not overwrite the file of --input"));
}

TEST_F(OutputFilesTest, TwoOutputsAreTwoFiles) {
  const auto refused = HasSubstr("--second must not be the file of --first");
  EXPECT_THAT(WhyNot("other", Files("plan", "plan")), refused);
  EXPECT_THAT(WhyNot("other", Files("plan", "hard")), refused);
  EXPECT_THAT(WhyNot("other", Files("new", "out/../new")), refused);
  EXPECT_THAT(WhyNot("other", Files("new", "dangling")), refused);
  EXPECT_THAT(WhyNot("other", Files("out/new", "out_link/new")), refused);
  EXPECT_EQ(WhyNot("other", Files("new", "newer")), "");
  const auto in_folder = HasSubstr("--output must not be the file of --first");
  EXPECT_THAT(WhyNot("other", AndFolder(Files("out/report"), "out")), in_folder);
  EXPECT_THAT(WhyNot("other", AndFolder(Files("new/report"), "new")), in_folder);
  EXPECT_THAT(WhyNot("other", AndFolder(Files("new/report"), "new/")), in_folder);
  EXPECT_EQ(WhyNot("other", AndFolder(Files("out/else"), "out")), "");
  EXPECT_EQ(WhyNot("other", AndFolder(Files("new/else"), "new")), "");
}

TEST_F(OutputFilesTest, WhatIsNoRegularFileMayBeNamedOften) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(WhyNot("pipe", Files("pipe", "pipe")), "");
}

TEST_F(OutputFilesTest, WhatCannotBeWrittenIsFoundAndNothingIsLeft) {
  EXPECT_EQ(WhyNotWritable(AndFolder(Files("new", "plan"), "out")), "");
  EXPECT_EQ(WhyNotWritable(AndFolder({}, "a/b/c/")), "");
  EXPECT_THAT(WhyNotWritable(Files("new", "missing/file")), HasSubstr("missing/file"));
  EXPECT_THAT(WhyNotWritable(AndFolder({}, "plan")), HasSubstr("plan: cannot be written"));
  EXPECT_THAT(WhyNotWritable(AndFolder({}, "plan/a/b")), HasSubstr("plan/a/b: cannot be written"));
  EXPECT_THAT(WhyNotWritable(AndFolder({}, "dangling")), HasSubstr("dangling: cannot be written"));
  OutputFiles none;
  none.folders.push_back(
      {"--output", "/proc/regrasp/out", [](const std::string&) { return false; }});
  EXPECT_THAT(WhyNotWritable(none), HasSubstr("/proc/regrasp/out: cannot be written"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 7);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out"), fs::directory_iterator()), 1);
}

TEST_F(OutputFilesTest, StandardOutputIsNeitherAFileNorAFolder) {
  OutputFiles file;
  file.Add("--first", "-");
  EXPECT_EQ(WhyNot("plan", file), "--first: - (standard output) is not supported, expected a file");
  OutputFiles folder;
  folder.folders.push_back({"--output", "-", [](const std::string&) { return true; }});
  EXPECT_EQ(WhyNot("plan", folder),
            "--output: - (standard output) is not supported, expected a folder");
  EXPECT_EQ(WhyNot("plan", Files("-")), "");
}

TEST_F(OutputFilesTest, AFileMayGoIntoAFolderThatWillBeMade) {
  EXPECT_EQ(WhyNotWritable(AndFolder(Files("new/file"), "new")), "");
  EXPECT_EQ(WhyNotWritable(AndFolder(Files("new/file"), "new/below")), "");
  EXPECT_THAT(WhyNotWritable(AndFolder(Files("new/below/file"), "new")), HasSubstr("below/file"));
  EXPECT_THAT(WhyNotWritable(AndFolder(Files("newer/file"), "new")), HasSubstr("newer/file"));
}

TEST_F(OutputFilesTest, AResultThatIsGoneIsNoBadInput) {
  EXPECT_EQ(ReadOutput(folder_ / "out/report"), "out/report");
  EXPECT_THROW((void)ReadOutput(folder_ / "gone"), EnvironmentError);
  EXPECT_THROW((void)ReadOutput("/proc/self/mem"), EnvironmentError);  // a file that cannot be read
}

TEST(PathForCiTest, IsFromTheWorkingFolderAndAbsoluteOutsideOfIt) {
  const fs::path here = fs::current_path();
  EXPECT_EQ(PathForCi("out/plans"), "out/plans");
  EXPECT_EQ(PathForCi("./out/../out/"), "out/");
  EXPECT_EQ(PathForCi(here / "out"), "out");
  EXPECT_EQ(PathForCi("."), ".");
  EXPECT_EQ(PathForCi("../out"), here.parent_path() / "out");
  EXPECT_EQ(PathForCi("/nowhere/out"), "/nowhere/out");
  EXPECT_EQ(PathForCi("..out"), "..out");
}

}  // namespace output_files_test

namespace entry_names_test {

TEST(EntryNames, SortAsTheirEntriesDo) {
  EXPECT_EQ(EntryFileName(plan::EntryIndex(0), "hold", "png"), "000_hold.png");
  EXPECT_EQ(EntryFileName(plan::EntryIndex(12), "align", "svg"), "012_align.svg");
  EXPECT_EQ(EntryFileName(plan::EntryIndex(1234), "switch", "pdf"), "1234_switch.pdf");
  EXPECT_LT(EntryFileName(plan::EntryIndex(9), "switch", "png"),
            EntryFileName(plan::EntryIndex(10), "align", "png"));
}

TEST(EntryNames, AreKnownByTheirNumberKindAndEnding) {
  int known = 0;
  for (const int number : {0, 7, 99, 1000}) {
    for (const char* kind : {"hold", "switch", "align", "move"}) {
      known += IsEntryFileName(EntryFileName(plan::EntryIndex(number), kind, "png"), "png") ? 1 : 0;
    }
  }
  EXPECT_EQ(known, 16);
  for (const char* other : {"00_hold.png", "000_hold.svg", "000_hold.png~", "000_rest.png", "000",
                            "x000_hold.png", "000hold.png", "_hold.png", ""}) {
    EXPECT_FALSE(IsEntryFileName(other, "png")) << other;
  }
}

TEST(EntryNames, ANumberIsAtLeastThreeDigitsAtTheBeginning) {
  EXPECT_EQ(AfterEntryNumber("003.svg"), ".svg");
  EXPECT_EQ(AfterEntryNumber("00345"), "");
  EXPECT_EQ(AfterEntryNumber("03.svg"), std::nullopt);
  EXPECT_EQ(AfterEntryNumber("a003"), std::nullopt);
}

}  // namespace entry_names_test
}  // namespace regrasp::apps
