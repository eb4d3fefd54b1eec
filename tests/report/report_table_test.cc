#include "report/report_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/base/number.h"
#include "report/failure.h"
#include "report/markup.h"
#include "report/report_json.h"
#include "sim/scene/scaling.h"

namespace regrasp::report {
namespace condition_table_test {

using testing::HasSubstr;

sim::ConditionResult Result(const std::string& name, plan::Reason reason) {
  sim::ConditionResult result;
  result.condition = {name, R"({"mass_factor": 0.5})"};
  result.reason = reason;
  if (reason != plan::Reason::kNone) result.failed = plan::EntryIndex(0);
  result.reaches_end = result.ends_within = true;
  result.end_m = 4e-4;
  result.end_rad = Radians(1.5);
  result.margin = reason == plan::Reason::kNone ? 0.75 : -2;
  return result;
}

/// Return a report whose only step passes, with four conditions: one fails, one is not applicable.
Report ReportWithConditions() {
  Report report;
  report.plan_file = "plan.json";
  ReportStep& step = report.steps.emplace_back();
  step.check.index = plan::EntryIndex(0);
  step.check.kind = "hold";
  step.replay.emplace();
  sim::ConditionSummary& summary = report.conditions.emplace();
  summary.results = {Result("light", plan::Reason::kNone), Result("icy", plan::Reason::kSlipped),
                     Result("heavy", plan::Reason::kNone), Result("odd", plan::Reason::kNone)};
  summary.results[3].applies = false;
  summary.results[3].ends_within = false;
  summary.results[3].detail = "no geometry";
  return report;
}

TEST(ConditionTableTest, ConditionsAreInformationUnlessTheyAreRequired) {
  Report report = ReportWithConditions();
  EXPECT_TRUE(report.passed());
  EXPECT_FALSE(DescribeFailure(report));
  EXPECT_EQ(VerdictHeadline(report), "pass under 2 of 3 conditions");
  EXPECT_THAT(FormatReportTable(report), HasSubstr("verdict: pass under 2 of 3 conditions\n"));
  report.conditions->required = 0.6;
  EXPECT_TRUE(report.passed());
  report.conditions->required = 0.7;
  EXPECT_FALSE(report.passed());
  const auto failure = DescribeFailure(report);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->headline(), "conditions-failed: 1 of 3 conditions fail: icy (slipped)");
  EXPECT_EQ(failure->why, "2 of 3 conditions pass (66.7 %), --conditions requires 70 %");
  const Json json = ReportJson(report);
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_EQ(json["conditions"]["why"], failure->why);
}

TEST(ConditionTableTest, EachConditionIsARow) {
  const std::string table = FormatConditionTable(ReportWithConditions());
  EXPECT_THAT(table, HasSubstr("condition  step  end_mm  end_deg  ends_within  margin"));
  EXPECT_THAT(table, HasSubstr("light      -     0.4     1.5      yes          0.75    pass\n"));
  EXPECT_THAT(table,
              HasSubstr("icy        0     0.4     1.5      yes          -2      fail: slipped\n"));
  EXPECT_THAT(table, HasSubstr("not applicable\n"));
  EXPECT_THAT(table, HasSubstr("conditions: 2 of 3 pass, 3 of 3 end within the tolerance\n"));
  EXPECT_EQ(FormatConditionTable(Report()), "");
}

TEST(ConditionTableTest, JsonHasTheResultOfEachCondition) {
  const Json json = ConditionsJson(*ReportWithConditions().conditions);
  EXPECT_EQ(json["verdict"], "pass");
  EXPECT_TRUE(json["required"].is_null());
  EXPECT_EQ(json["applicable"], 3);
  EXPECT_EQ(json["passed"], 2);
  EXPECT_EQ(json["results"][0]["verdict"], "pass");
  EXPECT_EQ(json["results"][0]["changes"]["mass_factor"], 0.5);
  EXPECT_EQ(json["results"][1]["reason"], "slipped");
  EXPECT_EQ(json["results"][1]["margin"], -2);
  EXPECT_EQ(json["results"][3]["verdict"], "skipped");
  EXPECT_FALSE(json["results"][3].contains("margin"));
}

TEST(ConditionTableTest, JunitHasACasePerCondition) {
  Report report = ReportWithConditions();
  const auto outcomes = [&] {
    std::vector<JunitOutcome> found;
    for (const JunitCase& one : MakeJunitSuite(report, "").cases) found.push_back(one.outcome);
    return found;
  };
  using enum JunitOutcome;
  EXPECT_THAT(outcomes(), testing::ElementsAre(kPassed, kPassed, kSkipped, kPassed, kSkipped));
  report.conditions->required = 1;
  EXPECT_THAT(outcomes(), testing::ElementsAre(kPassed, kPassed, kFailed, kPassed, kSkipped));
}

}  // namespace condition_table_test
}  // namespace regrasp::report

namespace regrasp::report {
namespace grasp_force_text_test {

TEST(GraspForceTextTest, HasAtMost60Characters) {
  constexpr std::size_t kMost = 60;
  for (const auto source : {sim::GraspForceSource::kDisturbance, sim::GraspForceSource::kHand,
                            sim::GraspForceSource::kTorques, sim::GraspForceSource::kGiven}) {
    // Only the default has no limit.
    const bool is_default = source == sim::GraspForceSource::kDisturbance;
    for (const double force_N :
         {sim::kStrongestGrip_N / 3, is_default ? 211912.3 : sim::kStrongestGrip_N}) {
      sim::ReplaySettings settings;
      settings.grasp_force_source = source;
      settings.grasp_force_N = force_N;
      settings.mass_kg = 0.2161234;
      const std::string text = GraspForceText(settings);
      const auto is_continued = [](char byte) { return (byte & 0xc0) == 0x80; };
      EXPECT_LE(text.size() - std::ranges::count_if(text, is_continued), kMost) << text;
      EXPECT_THAT(text, testing::HasSubstr(" × weight"));
    }
  }
}

}  // namespace grasp_force_text_test
}  // namespace regrasp::report
