#include "apps/batch/line_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace line_output_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string LineOf(std::int64_t entry) {
  return SealRecord(FormatNoResult(entry, Outcome::kNoPlan, "none"), entry, Sha256("inputs")) +
         "\n";
}

/// Keep the entries of an earlier run that `accept` accepts.
void Keep(
    LinesOutput& output,
    const LinesOutput::Accept& accept = [](std::string_view /*line*/) { return true; }) {
  while (output.KeepNext(accept)) {
  }
}

class LineOutputTest : public FolderTest {
 protected:
  LineOutputTest() : path_(folder_ / "plans.jsonl"), part_(folder_ / "plans.jsonl.part") {}

  [[nodiscard]] std::string Whole() const {
    return FormatHeader(header_) + LineOf(1) + LineOf(2) + LineOf(3);
  }

  template <class Error>
  std::string Refusal(const LinesHeader& header) const {
    try {
      LinesOutput output(path_, header, false);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  LinesHeader header_{"plans", 3, {}, "run"};
  fs::path path_, part_;
};

TEST_F(LineOutputTest, AppearsAsAWholeWhenAllEntriesAreThere) {
  LinesOutput output(path_, header_, false);
  output.Append(LineOf(1));
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_EQ(ReadFile(part_), FormatHeader(header_) + LineOf(1));
  output.Append(LineOf(2) + LineOf(3));
  EXPECT_EQ(output.next(), 4);
  output.Finish();
  EXPECT_EQ(ReadFile(path_), Whole());
  EXPECT_FALSE(fs::exists(part_));
  EXPECT_EQ(output.counts(), (OutcomeCounts{{Outcome::kNoPlan, 3}}));
}

TEST_F(LineOutputTest, GoesOnBehindTheLastWholeEntryWhereverAPartWasCut) {
  const std::string whole = Whole();
  const std::size_t header = FormatHeader(header_).size();
  const std::size_t entry = LineOf(1).size();
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    WriteFile(part_, whole.substr(0, length));
    {
      LinesOutput output(path_, header_, false);
      Keep(output);
      const std::size_t left = length < header ? 0 : (length - header) / entry;
      ASSERT_EQ(output.kept(), left) << length;
      for (std::int64_t next = output.next(); next <= 3; ++next) output.Append(LineOf(next));
      output.Finish();
    }
    ASSERT_EQ(ReadFile(path_), whole) << length;
    fs::remove(path_);
  }
}

TEST_F(LineOutputTest, WhatIsBehindALineThatIsNoneIsThrownAway) {
  WriteFile(part_, FormatHeader(header_) + LineOf(1) + "rubbish\n" + LineOf(3));
  LinesOutput output(path_, header_, false);
  Keep(output);
  EXPECT_EQ(output.next(), 2);
  EXPECT_EQ(ReadFile(part_), FormatHeader(header_) + LineOf(1));
}

TEST_F(LineOutputTest, AWholeFileOfTheSameRunIsKeptAndAnyOtherIsMadeAgain) {
  WriteFile(path_, Whole());
  {
    LinesOutput output(path_, header_, false);
    for (int entry = 1; entry <= 3; ++entry) {
      EXPECT_TRUE(output.KeepNext([](std::string_view /*line*/) { return true; }));
    }
    EXPECT_EQ(output.next(), 4);
    output.Finish();
    EXPECT_FALSE(fs::exists(part_));
  }
  const std::string whole = Whole();
  LinesHeader other = header_;
  other.run = "other";
  for (const std::string& bytes :
       {whole.substr(0, whole.size() - 1), whole + LineOf(4), FormatHeader(other)}) {
    WriteFile(path_, bytes);
    LinesOutput output(path_, header_, false);
    Keep(output);
    EXPECT_EQ(ReadFile(path_), bytes) << "the old file stays until the new one is there";
    for (std::int64_t next = output.next(); next <= 3; ++next) output.Append(LineOf(next));
    output.Finish();
    EXPECT_EQ(ReadFile(path_), whole);
    EXPECT_FALSE(fs::exists(part_));
  }
  WriteFile(path_, whole);
  LinesOutput fresh(path_, header_, true);
  EXPECT_EQ(fresh.next(), 1);
}

TEST_F(LineOutputTest, APartOfAnotherRunOrOfSomebodyElseIsNotTouched) {
  LinesHeader other = header_;
  other.run = "other";
  const std::string bytes = FormatHeader(other) + LineOf(1);
  WriteFile(part_, bytes);
  EXPECT_THAT(Refusal<InputError>(header_),
              HasSubstr("plans.jsonl.part: line 1: belongs to an interrupted run"));
  EXPECT_EQ(ReadFile(part_), bytes);
  {
    LinesOutput fresh(path_, header_, true);
    EXPECT_EQ(fresh.next(), 1);
  }
  WriteFile(part_, "my own notes\n");
  EXPECT_THAT(Refusal<InputError>(header_),
              HasSubstr("cannot overwrite a file that regrasp did not write"));
  EXPECT_THROW(LinesOutput(path_, header_, true), InputError);
  EXPECT_EQ(ReadFile(part_), "my own notes\n");
}

TEST_F(LineOutputTest, APipeInTheWayIsRefusedUnread) {
  ASSERT_EQ(mkfifo(part_.c_str(), 0600), 0);
  EXPECT_THAT(Refusal<InputError>(header_), HasSubstr("plans.jsonl.part: cannot be replaced"));
  fs::remove(part_);
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  LinesOutput output(path_, header_, false);
  EXPECT_FALSE(output.FindEarlier(1, [](std::string_view /*line*/) { return true; }));
}

TEST_F(LineOutputTest, OneProcessAtATimeWritesIt) {
  LinesOutput output(path_, header_, false);
  output.Append(LineOf(1));
  EXPECT_THAT(Refusal<EnvironmentError>(header_), HasSubstr("another process writes this file"));
  EXPECT_EQ(ReadFile(part_), FormatHeader(header_) + LineOf(1));
}

TEST_F(LineOutputTest, AProcessThatIsKilledLeavesItToTheNext) {
  const pid_t child = fork();
  if (child == 0) {
    LinesOutput output(path_, header_, false);
    output.Append(LineOf(1));
    raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  LinesOutput output(path_, header_, false);
  Keep(output);
  EXPECT_EQ(output.next(), 2);
}

TEST_F(LineOutputTest, ALineThatIsNotAcceptedIsReplacedAndThoseBehindItAreFound) {
  for (const fs::path& path : {path_, part_}) {
    WriteFile(path, Whole());
    LinesOutput output(path_, header_, false);
    const auto accept = [](std::string_view line) { return EntryOf(line) != 2; };
    Keep(output, accept);
    EXPECT_EQ(output.next(), 2);
    EXPECT_FALSE(output.FindEarlier(2, accept));
    const auto third = output.FindEarlier(3, accept);
    ASSERT_TRUE(third);
    EXPECT_EQ(output.kept(), 2);
    output.Append(FormatNoResult(2, Outcome::kNoPlan, "other") + "\n" + *third + "\n");
    output.Finish();
    EXPECT_EQ(ReadFile(path_), FormatHeader(header_) + LineOf(1) +
                                   FormatNoResult(2, Outcome::kNoPlan, "other") + "\n" + LineOf(3));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
    fs::remove(path_);
  }
}

TEST_F(LineOutputTest, WhatAPartHadBehindAReplacedLineSurvivesFurtherKills) {
  WriteFile(part_, Whole());
  const auto accept = [](std::string_view line) { return EntryOf(line) != 1; };
  for (int kill = 0; kill < 3; ++kill) {
    // Killed before it wrote entry 1.
    LinesOutput output(path_, header_, false);
    Keep(output, accept);
    EXPECT_FALSE(output.FindEarlier(1, accept));
    EXPECT_EQ(ReadFile(part_), FormatHeader(header_));
  }
  LinesOutput output(path_, header_, false);
  Keep(output, accept);
  EXPECT_FALSE(output.FindEarlier(1, accept));
  output.Append(LineOf(1));
  for (const std::int64_t entry : {2, 3}) {
    const auto found = output.FindEarlier(entry, accept);
    ASSERT_TRUE(found) << entry;
    output.Append(*found + "\n");
  }
  output.Finish();
  EXPECT_EQ(ReadFile(path_), Whole());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(LineOutputTest, AStaleWholeAndThePartOfItsReplacementAreBothSearched) {
  const std::string stale =
      SealRecord(FormatNoResult(1, Outcome::kNoPlan, "stale"), 1, Sha256("inputs")) + "\n";
  WriteFile(path_, FormatHeader(header_) + stale + LineOf(2) + LineOf(3));
  WriteFile(part_, FormatHeader(header_) + LineOf(1));
  const auto accept = [](std::string_view line) {
    return line.find("stale") == std::string_view::npos;
  };
  LinesOutput output(path_, header_, false);
  Keep(output, accept);
  EXPECT_EQ(output.next(), 1);
  for (std::int64_t entry = 1; entry <= 3; ++entry) {
    const auto found = output.FindEarlier(entry, accept);
    ASSERT_TRUE(found) << entry;
    output.Append(*found + "\n");
  }
  output.Finish();
  EXPECT_EQ(ReadFile(path_), Whole());
}

TEST_F(LineOutputTest, EntriesComeInOrder) {
  LinesOutput output(path_, header_, false);
  EXPECT_THROW(output.Append(LineOf(2)), std::logic_error);
}

TEST_F(LineOutputTest, AFolderThatIsMissingIsTheMachinesFault) {
  path_ = folder_ / "gone" / "plans.jsonl";
  EXPECT_THAT(Refusal<EnvironmentError>(header_), HasSubstr("plans.jsonl.part: cannot be written"));
}

}  // namespace line_output_test
}  // namespace regrasp::apps
