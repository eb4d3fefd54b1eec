#include "apps/batch/line_records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/base/error.h"

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
}  // namespace regrasp::apps
