#include "apps/batch/batch_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/batch/batch_page.h"
#include "tests/apps/batch/plan_outcomes.h"

namespace regrasp::apps {
namespace batch_summary_test {

using testing::HasSubstr;
using testing::Not;

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
  EXPECT_EQ(json["page"], "index.html");
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
  const std::string xml = FormatSummaryJunit(All(), "out/plans");
  EXPECT_THAT(xml,
              HasSubstr("<testsuite name=\"weak.json\" tests=\"3\" failures=\"1\" errors=\"0\" "
                        "skipped=\"1\" time=\"0.000\">"));
  EXPECT_THAT(xml,
              HasSubstr("<failure message=\"slipped\">finger &lt;2&gt; slipped\nwhy: it stays\n"
                        "help: more friction\n"
                        "picture: out/plans/weak/001_switch.png</failure>"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"crash.json\" tests=\"1\" failures=\"0\" "
                             "errors=\"1\" skipped=\"0\" time=\"0.000\">"));
  EXPECT_THAT(xml, HasSubstr("<error message=\"bad-input\">broken.json: not JSON</error>"));
}

TEST(BatchSummaryTest, JunitTellsWhatThisRunTook) {
  BatchSummary summary{{Passed("good")}, {}};
  summary.plans[0].seconds = 0.75;
  summary.plans[0].entry_seconds = {0.5, 0.125};
  const std::string xml = FormatSummaryJunit(summary, "out");
  EXPECT_THAT(xml, HasSubstr("skipped=\"0\" time=\"0.750\">"));
  EXPECT_THAT(xml, HasSubstr("name=\"step 0 hold\" time=\"0.500\""));
  EXPECT_THAT(xml, HasSubstr("name=\"step 1 switch\" time=\"0.125\""));
  // Neither the summary nor the page contains times.
  const BatchSummary untimed{{Passed("good")}, {}};
  EXPECT_EQ(FormatSummaryJson(summary), FormatSummaryJson(untimed));
  EXPECT_EQ(FormatBatchPage(summary), FormatBatchPage(untimed));
}

TEST(BatchSummaryTest, NamesOfAnyBytesBreakNothing) {
  const BatchSummary summary{{Passed("a\nb\xFF\"<")}, {}};
  EXPECT_EQ(std::ranges::count(FormatSummaryTable(summary), '\n'), 3);
  EXPECT_TRUE(Json::accept(FormatSummaryJson(summary)));
  EXPECT_THAT(FormatSummaryJunit(summary, "out"), HasSubstr("&quot;&lt;"));
}

TEST(BatchSummaryTest, TrialsThatFailAreNotHiddenByAPass) {
  PlanOutcome some = Passed("some");
  some.report->trials = ReportSummary::Trials{20, 14};
  PlanOutcome few = Passed("few");
  few.verdict = PlanVerdict::kFail;
  few.report->passed = false;
  few.report->trials = ReportSummary::Trials{
      20, 2, "18 of 20 trials with noise fail", "it is so", "more friction", false};
  const BatchSummary summary{{Passed("good"), some, few}, {}};
  const std::string table = FormatSummaryTable(summary);
  EXPECT_THAT(table, HasSubstr("passes in 14 of 20 trials\n"));
  EXPECT_THAT(table, HasSubstr("trials-failed: passes in 2 of 20 trials\n"));
  EXPECT_THAT(table, HasSubstr("2 pass, 1 fail, 0 bad-input, 0 error; 1 pass in only a part of "
                               "their trials\n"));
  const Json json = Json::parse(FormatSummaryJson(summary));
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_FALSE(json["plans"][0].contains("trials"));
  EXPECT_EQ(json["plans"][1]["trials"]["passed"], 14);
  EXPECT_EQ(json["plans"][2]["reason"], "trials-failed");
  EXPECT_TRUE(json["plans"][2]["failed_step"].is_null());
  const std::string xml = FormatSummaryJunit(summary, "out");
  EXPECT_THAT(xml, HasSubstr("<failure message=\"trials-failed\">18 of 20 trials with noise fail\n"
                             "why: it is so\nhelp: more friction</failure>"));
  const std::string page = FormatBatchPage(summary);
  EXPECT_THAT(page, HasSubstr("<td class=\"outcome\">Pass in 14 of 20 trials</td>"));
  EXPECT_THAT(page,
              HasSubstr("<td>trials-failed</td><td>Trials: 18 of 20 trials with noise fail."));
  EXPECT_THAT(page, HasSubstr("1 pass in only a part of their trials."));
}

}  // namespace batch_summary_test
}  // namespace regrasp::apps
