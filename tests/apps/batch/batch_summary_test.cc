#include "apps/batch/batch_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace regrasp::apps {
namespace {

using testing::HasSubstr;
using testing::Not;

PlanOutcome Passed(const std::string& name) {
  PlanOutcome plan{name, name + ".json", PlanVerdict::kPass, ReportSummary(), "", false};
  plan.report->passed = true;
  plan.report->entries = {{"hold", "pass", "", "", ""}, {"switch", "pass", "", "", ""}};
  plan.report->weakest_step = 1;
  plan.report->required_half_angle_deg = 17.25;
  return plan;
}

PlanOutcome Failed(const std::string& name) {
  PlanOutcome plan = Passed(name);
  plan.verdict = PlanVerdict::kFail;
  plan.report->passed = false;
  plan.report->entries[1] = {"switch", "fail", "slipped", "finger <2> slipped", ""};
  plan.report->entries.push_back({"align", "skipped", "", "", ""});
  return plan;
}

PlanOutcome Broken(const std::string& name, PlanVerdict verdict, const std::string& message) {
  return {name, name + ".json", verdict, std::nullopt, message, false};
}

BatchSummary All() {
  return {{Passed("good"), Failed("weak"),
           Broken("broken", PlanVerdict::kBadInput, "broken.json: not JSON"),
           Broken("crash", PlanVerdict::kError, "crashed: Aborted")},
          {{"grasp.json", "is a regrasp-grasp file"}}};
}

TEST(BatchSummaryTest, TheWorstVerdictIsThatOfTheBatch) {
  EXPECT_EQ(All().verdict(), PlanVerdict::kError);
  EXPECT_EQ((BatchSummary{{Passed("a"), Passed("b")}, {}}).verdict(), PlanVerdict::kPass);
  EXPECT_EQ((BatchSummary{{Failed("a"), Passed("b")}, {}}).verdict(), PlanVerdict::kFail);
  EXPECT_EQ((BatchSummary{{Broken("a", PlanVerdict::kBadInput, ""), Failed("b")}, {}}).verdict(),
            PlanVerdict::kBadInput);
}

TEST(BatchSummaryTest, TheTableHasALineForEachPlanAndCounts) {
  const std::string table = FormatSummaryTable(All());
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 4 + 1 + 1);
  EXPECT_THAT(table, HasSubstr("good    pass       1      1        17.25         -\n"));
  EXPECT_THAT(table,
              HasSubstr("weak    fail       2      1        17.25         slipped in step 1\n"));
  EXPECT_THAT(table,
              HasSubstr("broken  bad-input  -      -        -             broken.json: not"));
  EXPECT_THAT(table, HasSubstr("skipped: grasp.json is a regrasp-grasp file\n"));
  EXPECT_THAT(table, HasSubstr("\n4 plans: 1 pass, 1 fail, 1 bad-input, 1 error\n"));
}

TEST(BatchSummaryTest, TheTableSaysWhatWasKeptAndTheFileDoesNot) {
  BatchSummary summary = All();
  summary.plans[0].kept = true;
  EXPECT_THAT(FormatSummaryTable(summary), HasSubstr("; 1 kept from an earlier run\n"));
  EXPECT_THAT(FormatSummaryTable(All()), Not(HasSubstr("kept")));
  EXPECT_EQ(FormatSummaryJson(summary), FormatSummaryJson(All()));
}

TEST(BatchSummaryTest, TheFileHasEveryPlanWithItsReportOrItsMessage) {
  const Json json = Json::parse(FormatSummaryJson(All()));
  EXPECT_EQ(json["format"], "regrasp-summary");
  EXPECT_EQ(json["verdict"], "error");
  EXPECT_EQ(json["counts"]["plans"], 4);
  EXPECT_EQ(json["plans"][0]["report"], "good/report.json");
  EXPECT_EQ(json["plans"][0]["steps"], 1);
  EXPECT_EQ(json["plans"][1]["reason"], "slipped");
  EXPECT_EQ(json["plans"][1]["failed_step"], 1);
  EXPECT_EQ(json["plans"][2]["message"], "broken.json: not JSON");
  EXPECT_TRUE(json["plans"][3]["report"].is_null());
  EXPECT_EQ(json["skipped"][0]["file"], "grasp.json");
}

TEST(BatchSummaryTest, JunitHasASuiteForEachPlanAndAnErrorWhereThereIsNoReport) {
  const std::string xml = FormatSummaryJunit(All());
  EXPECT_THAT(xml,
              HasSubstr("<testsuite name=\"weak.json\" tests=\"3\" failures=\"1\" errors=\"0\" "
                        "skipped=\"1\">"));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"slipped\">finger &lt;2&gt; slipped</failure>"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"crash.json\" tests=\"1\" failures=\"0\" "
                             "errors=\"1\" skipped=\"0\">"));
  EXPECT_THAT(xml, HasSubstr("<error message=\"bad-input\">broken.json: not JSON</error>"));
}

TEST(BatchSummaryTest, NamesOfAnyBytesBreakNothing) {
  const BatchSummary summary{{Passed("a\nb\xFF\"<")}, {}};
  EXPECT_EQ(std::ranges::count(FormatSummaryTable(summary), '\n'), 3);
  EXPECT_TRUE(Json::accept(FormatSummaryJson(summary)));
  EXPECT_THAT(FormatSummaryJunit(summary), HasSubstr("&quot;&lt;"));
}

}  // namespace
}  // namespace regrasp::apps
