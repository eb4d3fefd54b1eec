#include "apps/batch/line_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace line_run_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kEntries = 100;

/// Fixture of lines with one word each; odd entries take more work.
class LineRunTest : public FolderTest {
 protected:
  LineRunTest() {
    std::string bytes;
    for (int entry = 1; entry <= kEntries; ++entry) {
      bytes += (entry % 7 == 0 ? bad_ : "good") + std::to_string(entry / 30) + "\n";
    }
    input_ = Write("in.jsonl", bytes);
  }

  /// @returns content of the final file.
  std::string Run(LineRunOptions options) {
    messages_.clear();
    prepared_.clear();
    options.on_message = [this](const std::string& message) { messages_.push_back(message); };
    options.on_progress = [this] { ++progress_; };
    LineWork work;
    work.group = [](const Line& line) { return line.text; };
    work.prepare = [this](const Line& line) { prepared_.push_back(line.text); };
    work.work = [this](const Line& line) { return Work(line); };
    if (seals_) work.inputs = DigestOf;
    const fs::path path = folder_ / "out.jsonl";
    LinesInput input(input_);
    LinesOutput output(path, {"plans", input.entries(), {}, "run"}, true);
    EXPECT_EQ(RunLines(input, output, work, options), 0);
    output.Finish();
    return ReadFile(path);
  }

  static std::string DigestOf(const Line& line) { return Sha256(line.text); }

  std::string Work(const Line& line) const {
    if (line.text.starts_with("crash")) raise(SIGSEGV);
    if (line.text.starts_with("exit")) _exit(9);
    if (line.text.starts_with("hang")) pause();
    return FormatNoResult(line.entry, Outcome::kNoPlan, line.text);
  }

  static std::string Expected(const std::string& bad, const std::string& why) {
    std::string text = FormatHeader({"plans", kEntries, {}, "run"});
    for (int entry = 1; entry <= kEntries; ++entry) {
      const std::string good = "good" + std::to_string(entry / 30);
      text += (entry % 7 == 0 && !bad.empty() ? FormatNoResult(entry, Outcome::kError, why)
               : entry % 7 == 0
                   ? FormatNoResult(entry, Outcome::kNoPlan, "fine" + std::to_string(entry / 30))
                   : FormatNoResult(entry, Outcome::kNoPlan, good)) +
              "\n";
    }
    return text;
  }

  void WriteInput(const std::string& bad) {
    bad_ = bad;
    std::string bytes;
    for (int entry = 1; entry <= kEntries; ++entry) {
      bytes += (entry % 7 == 0 ? bad : "good") + std::to_string(entry / 30) + "\n";
    }
    input_ = Write("in.jsonl", bytes);
  }

  std::string bad_ = "fine";
  bool seals_ = false;
  fs::path input_;
  std::vector<std::string> messages_, prepared_;
  int progress_ = 0;
};

TEST_F(LineRunTest, ResultsComeInTheOrderOfTheInputWhateverTheJobs) {
  WriteInput("fine");
  for (const int jobs : {1, 2, 5}) {
    EXPECT_EQ(Run({jobs, {}, {}, {}}), Expected("", "")) << jobs;
    EXPECT_TRUE(messages_.empty());
    EXPECT_GT(progress_, 0);
  }
}

TEST_F(LineRunTest, WhatLinesHaveInCommonIsPreparedOnceInThisProcess) {
  WriteInput("fine");
  (void)Run({2, {}, {}, {}});
  EXPECT_EQ(prepared_.size(), 8U);
  EXPECT_EQ(std::set(prepared_.begin(), prepared_.end()).size(), 8U);
}

TEST_F(LineRunTest, AnEntryWhoseProcessEndsEarlyIsAnErrorAndStopsNoOther) {
  const std::string crashed = "crashed: " + std::string(strsignal(SIGSEGV));
  for (const auto& [word, why] :
       {std::pair("crash", crashed), {"exit", "ended with exit code 9"}}) {
    WriteInput(word);
    EXPECT_EQ(Run({3, {}, {}, {}}), Expected(word, why));
    EXPECT_EQ(messages_.size(), static_cast<std::size_t>(kEntries / 7));
    EXPECT_THAT(messages_.front(), HasSubstr("in.jsonl: line "));
    EXPECT_THAT(messages_.front(), HasSubstr(why));
  }
}

TEST_F(LineRunTest, AnEntryThatTakesTooLongIsStopped) {
  Write("in.jsonl", "good0\nhang0\ngood0\n");
  const std::string found = Run({1, 0.2, {}, {}});
  EXPECT_EQ(found, FormatHeader({"plans", 3, {}, "run"}) +
                       FormatNoResult(1, Outcome::kNoPlan, "good0") + "\n" +
                       FormatNoResult(2, Outcome::kError, "took longer than --time-limit 0.2") +
                       "\n" + FormatNoResult(3, Outcome::kNoPlan, "good0") + "\n");
}

TEST_F(LineRunTest, GoesOnWhereAnEarlierRunWasStopped) {
  WriteInput("fine");
  seals_ = true;
  const std::string whole = Run({2, {}, {}, {}});
  const std::size_t half = whole.find(R"({"query":50,)");
  Write("out.jsonl.part", whole.substr(0, half + 5));
  fs::remove(folder_ / "out.jsonl");
  LinesInput input(input_);
  LinesOutput output(folder_ / "out.jsonl", {"plans", kEntries, {}, "run"}, false);
  std::vector<std::int64_t> prepared;
  LineWork work;
  work.inputs = DigestOf;
  work.group = [](const Line& line) { return line.name; };
  work.prepare = [&](const Line& line) { prepared.push_back(line.entry); };
  work.work = [this](const Line& line) { return Work(line); };
  EXPECT_EQ(RunLines(input, output, work, {2, {}, [](const std::string&) {}, [] {}}), 0);
  output.Finish();
  EXPECT_EQ(output.kept(), 49);
  EXPECT_EQ(ReadFile(folder_ / "out.jsonl"), whole);
  EXPECT_EQ(prepared.front(), 50) << "what stands there already is not done again";
  EXPECT_EQ(prepared.size(), 51U);
}

}  // namespace line_run_test
}  // namespace regrasp::apps
