#include "apps/batch/line_records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace line_records_test {

using testing::HasSubstr;

template <class Action>
std::string Refusal(const Action& action) {
  try {
    (void)action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(ShardTest, ShardsInOrderCoverEveryEntryOnceAndDifferByOneAtMost) {
  int checked = 0;
  for (const std::int64_t entries : {0, 1, 7, 100, 1'000'000}) {
    for (const int count : {1, 2, 3, 7, 101}) {
      std::int64_t next = 1;
      for (int number = 1; number <= count; ++number) {
        const EntryRange range = Shard{number, count}.Of(entries);
        EXPECT_EQ(range.first, next);
        EXPECT_GE(range.count(), entries / count);
        EXPECT_LE(range.count(), entries / count + 1);
        next = range.last + 1;
        ++checked;
      }
      EXPECT_EQ(next, entries + 1);
    }
  }
  EXPECT_EQ(checked, 5 * (1 + 2 + 3 + 7 + 101));
  EXPECT_EQ((Shard{kMostShards, kMostShards}.Of(kMostEntries).last), kMostEntries);
}

TEST(ShardTest, IsWrittenAsPartOfCount) {
  EXPECT_EQ(ParseShard("--shard", "2/4"), (Shard{2, 4}));
  EXPECT_EQ(ParseShard("--shard", "1/1"), Shard());
  for (const char* text :
       {"", "2", "0/4", "5/4", "-1/4", "2/0", "2/4/8", "a/4", "2/", "/4", "2/ 4", "1/1000001"}) {
    EXPECT_THAT(Refusal([&] { return ParseShard("--shard", text); }),
                HasSubstr("--shard: expected I/N"))
        << text;
  }
}

TEST(LinesHeaderTest, ReadsBackAsItWasWrittenAndNothingElseIsOne) {
  const LinesHeader header{"plans", 100, {2, 4}, "abc"};
  const std::string text = FormatHeader(header);
  EXPECT_EQ(text.back(), '\n');
  const std::string line = text.substr(0, text.size() - 1);
  EXPECT_EQ(ParseHeader(line, "a.jsonl"), header);
  EXPECT_EQ(header.range(), (EntryRange{26, 50}));
  EXPECT_EQ(ParseHeader(R"({"format":"regrasp-plan","version":1})", "a.jsonl"), std::nullopt);
  EXPECT_EQ(ParseHeader("", "a.jsonl"), std::nullopt);
  // Lines that were truncated or edited.
  const std::vector<std::string> bads = {line.substr(0, line.size() - 3),
                                         line + " ",
                                         R"({"format":"regrasp-lines","version":2})",
                                         FormatHeader({"plans", -1, {}, "abc"}),
                                         FormatHeader({"plans", kMostEntries + 1, {}, "abc"}),
                                         FormatHeader({"plans", 1, {2, 1}, "abc"})};
  for (const std::string& bad : bads) {
    EXPECT_THAT(Refusal([&] { return ParseHeader(bad, "a.jsonl"); }), HasSubstr("a.jsonl")) << bad;
  }
}

TEST(LineRecordTest, IsToldByItsEntryAndWhatItCameTo) {
  const std::string plan = FormatRecord(7, {{"format", "regrasp-plan"}, {"version", 1}});
  EXPECT_EQ(plan, R"({"query":7,"format":"regrasp-plan","version":1})");
  EXPECT_EQ(OutcomeOf(plan, 7), Outcome::kPlan);
  for (const Outcome outcome : {Outcome::kNoPlan, Outcome::kBadInput, Outcome::kError}) {
    const std::string line = FormatNoResult(12, outcome, "two\nlines");
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_EQ(OutcomeOf(line, 12), outcome);
  }
  for (const auto& [word, outcome] :
       {std::pair("pass", Outcome::kPass), {"fail", Outcome::kFail}}) {
    const Json report = {{"format", "regrasp-report"}, {"version", 1}, {"verdict", word}, {"x", 1}};
    EXPECT_EQ(OutcomeOf(FormatRecord(1, report), 1), outcome);
  }
  // Other entry, truncated, or different text.
  EXPECT_EQ(OutcomeOf(plan, 8), std::nullopt);
  EXPECT_EQ(OutcomeOf(plan, 70), std::nullopt);
  EXPECT_EQ(OutcomeOf(plan.substr(0, plan.size() - 1), 7), std::nullopt);
  EXPECT_EQ(OutcomeOf(R"({"query":7,"format":"regrasp-grasp","version":1})", 7), std::nullopt);
  EXPECT_EQ(OutcomeOf("", 7), std::nullopt);
}

TEST(OutcomeCountsTest, CountsInTheOrderOfWhatIsGoodFirst) {
  EXPECT_EQ(OutcomeCountsText({}), "0 entries");
  EXPECT_EQ(OutcomeCountsText({{Outcome::kPlan, 1}}), "1 entry: 1 plan");
  EXPECT_EQ(OutcomeCountsText({{Outcome::kError, 2}, {Outcome::kPass, 3}}),
            "5 entries: 3 pass, 2 error");
}

}  // namespace line_records_test

namespace line_input_test {

using testing::ElementsAre;
using testing::HasSubstr;

class LineInputTest : public FolderTest {
 protected:
  static std::vector<std::pair<std::int64_t, std::string>> All(LinesInput input) {
    std::vector<std::pair<std::int64_t, std::string>> all;
    while (const auto line = input.Next()) all.emplace_back(line->entry, line->text);
    return all;
  }

  std::string Refusal(const std::string& bytes, const Shard& shard = {}) const {
    try {
      (void)LinesInput(Write("a.jsonl", bytes), shard);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was refused";
  }
};

TEST_F(LineInputTest, EveryLineIsAnEntryNumberedFromOne) {
  const std::string bytes = "one\ntwo\n\nfour";
  LinesInput input(Write("a.jsonl", bytes));
  EXPECT_EQ(input.entries(), 4);
  EXPECT_EQ(input.source(), Sha256(bytes));
  EXPECT_FALSE(input.header());
  const auto first = input.Next();
  EXPECT_EQ(first->name, (folder_ / "a.jsonl").string() + ": line 1");
  EXPECT_THAT(All(std::move(input)),
              ElementsAre(std::pair(2, "two"), std::pair(3, ""), std::pair(4, "four")));
  EXPECT_TRUE(All(LinesInput(Write("empty.jsonl", ""))).empty());
}

TEST_F(LineInputTest, AHeaderMayFollowAByteOrderMark) {
  const std::string header = FormatHeader({"plans", 2, {1, 1}, std::string(64, 'a')});
  const LinesInput input(Write("a.jsonl", "\xEF\xBB\xBF" + header + "one\ntwo\n"));
  ASSERT_TRUE(input.header());
  EXPECT_EQ(input.entries(), 2);
  EXPECT_THAT(Refusal(std::string("\xFF\xFE{\0}\0\n\0", 8)),
              HasSubstr("a.jsonl: line 1: text encoding: not supported, expected UTF-8, found "
                        "UTF-16"));
}

TEST_F(LineInputTest, LinesMayEndAsOnWindows) {
  EXPECT_THAT(All(LinesInput(Write("a.jsonl", "one\r\n\r\ntwo\r"))),
              ElementsAre(std::pair(1, "one"), std::pair(2, ""), std::pair(3, "two")));
  std::string header = FormatHeader({"plans", 1, {}, "run"});
  header.insert(header.size() - 1, "\r");
  const LinesInput input(Write("b.jsonl", header + "a\r\n"));
  ASSERT_TRUE(input.header());
  EXPECT_EQ(input.header()->run, "run");
}

TEST_F(LineInputTest, AShardKeepsTheNumbersOfTheWhole) {
  const auto path = Write("a.jsonl", "a\nb\nc\nd\ne\n");
  EXPECT_THAT(All(LinesInput(path, {1, 2})), ElementsAre(std::pair(1, "a"), std::pair(2, "b")));
  EXPECT_THAT(All(LinesInput(path, {2, 2})),
              ElementsAre(std::pair(3, "c"), std::pair(4, "d"), std::pair(5, "e")));
  LinesInput later(path, {2, 2});
  later.SkipTo(5);
  EXPECT_THAT(All(std::move(later)), ElementsAre(std::pair(5, "e")));
}

TEST_F(LineInputTest, AHeaderSaysWhichEntriesFollow) {
  const std::string header = FormatHeader({"plans", 6, {2, 3}, "run"});
  LinesInput input(Write("a.jsonl", header + "c\nd\n"));
  EXPECT_EQ(input.entries(), 6);
  EXPECT_EQ(input.shard(), (Shard{2, 3}));
  EXPECT_EQ(input.source(), "run");
  const auto first = input.Next();
  EXPECT_EQ(first->entry, 3);
  EXPECT_THAT(first->name, HasSubstr("line 2"));
  EXPECT_THAT(All(std::move(input)), ElementsAre(std::pair(4, "d")));
  // A whole file can be split, a shard cannot be split again.
  const std::string whole = FormatHeader({"plans", 2, {}, "run"}) + "a\nb\n";
  EXPECT_THAT(All(LinesInput(Write("b.jsonl", whole), {2, 2})), ElementsAre(std::pair(2, "b")));
  EXPECT_THAT(Refusal(header + "c\nd\n", {1, 2}),
              HasSubstr("a.jsonl: --shard cannot be used with a file that is shard 2 of 3"));
}

TEST_F(LineInputTest, AFileWithMoreOrFewerEntriesThanItsHeaderSaysIsRefused) {
  const std::string header = FormatHeader({"plans", 2, {}, "run"});
  EXPECT_EQ(Refusal(header + "a\nb\n"), "nothing was refused");
  EXPECT_THAT(Refusal(header + "a\n"),
              HasSubstr("a.jsonl: expected 2 entries as in the header, found 1"));
  EXPECT_THAT(Refusal(header + "a\nb"),
              HasSubstr("a.jsonl: truncated inside line 3: expected 2 entries"));
  EXPECT_THAT(Refusal(header + "a\nb\nc\n"),
              HasSubstr("expected 2 entries as in the header, found 3"));
}

TEST_F(LineInputTest, WhatIsNoFileIsRefused) {
  for (const auto& [path, why] :
       {std::pair(folder_ / "gone", "no such file"), {folder_, "expected a regular file"}}) {
    try {
      (void)LinesInput(path);
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  }
}

TEST_F(LineInputTest, AFileThatShrinksMeanwhileIsNoticed) {
  // Longer than the read-ahead of a stream.
  const std::string line(std::size_t{1} << 16, 'x');
  const auto path = Write("a.jsonl", line + "\n" + line + "\n");
  LinesInput input(path);
  EXPECT_TRUE(input.Next());
  std::filesystem::resize_file(path, 10);
  EXPECT_THROW((void)input.Next(), InputError);
}

}  // namespace line_input_test
}  // namespace regrasp::apps
