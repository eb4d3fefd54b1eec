#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "planner/base/json.h"
#include "planner/base/number.h"
#include "report/page/report_page.h"
#include "report/report.h"

namespace regrasp::report {
namespace hand_limits_test {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Return a report of an initial grasp by a hand with two joints.
Report HandReport(double first_torque, double second_torque) {
  Report report;
  report.object_file = "cube.obj";
  report.plan_file = "plan.json";
  report.friction_angle = Radians(20);
  report.settings.emplace();
  report.settings->diameter_m = 0.06;
  report.settings->hand.emplace();
  report.settings->hand->limits = {
      {FingerIndex(0), "ffj1", "ffa1", first_torque, std::array<double, 2>{-0.25, 1.5}, -0.5, 1},
      {FingerIndex(1), "thj1", "tha1", second_torque, std::nullopt, 0, 1}};
  ReportStep& step = report.steps.emplace_back();
  step.check.index = plan::EntryIndex(0);
  step.check.kind = "hold";
  step.check.force_closure = true;
  step.check.required = grasp::RequiredFrictionAngle{Radians(12), Radians(12)};
  step.replay.emplace();
  step.replay->hand.emplace();
  step.replay->hand->torque_Nm = 1.17;
  return report;
}

std::string PageOf(const Report& report) {
  plan::Plan plan;
  plan.friction_angle = report.friction_angle;
  return FormatReportHtml(report, plan, {}, {});
}

TEST(HandLimitsTest, LimitsAreInTheJsonTheTableAndThePage) {
  const Report report = HandReport(0.5, 2);
  const Json json = ParseJson(FormatReportJson(report), "report");
  const Json& limits = json["settings"]["hand"]["limits"];
  ASSERT_EQ(limits.size(), 2U);
  EXPECT_EQ(limits[0]["joint"], "ffj1");
  EXPECT_EQ(limits[0]["actuator"], "ffa1");
  EXPECT_EQ(limits[0]["torque_Nm"], 0.5);
  EXPECT_EQ(limits[0]["control"], Json::array({-0.25, 1.5}));
  EXPECT_NEAR(limits[0]["range_deg"][1].get<double>(), Degrees(1), 1e-9);
  EXPECT_TRUE(limits[1]["control"].is_null());
  EXPECT_EQ(json["steps"][0]["simulation"]["hand"]["torque_Nm"], 1.17);
  EXPECT_THAT(FormatReportTable(report),
              HasSubstr("limits: torque 0.5 to 2 N·m, 1 control range, 2 joint ranges\n"));
  const std::string page = PageOf(report);
  EXPECT_THAT(page, HasSubstr("Limits that the verdict relies on"));
  EXPECT_THAT(page, HasSubstr("tha1"));
  EXPECT_THAT(page, Not(HasSubstr("unknown")));
  EXPECT_THAT(Warnings(report), IsEmpty());
}

TEST(HandLimitsTest, AForceLimitThatTheModelDoesNotGiveIsNamedEverywhere) {
  const Report report = HandReport(kUnlimited, 2);
  const Json json = ParseJson(FormatReportJson(report), "report");
  EXPECT_TRUE(json["settings"]["hand"]["limits"][0]["torque_Nm"].is_null());
  EXPECT_EQ(json["settings"]["hand"]["limits"][1]["torque_Nm"], 2);
  EXPECT_THAT(FormatReportTable(report), HasSubstr("force limit unknown for 1 of 2 actuators"));
  EXPECT_THAT(PageOf(report), HasSubstr("unknown"));
  ASSERT_THAT(Warnings(report), SizeIs(1));
  EXPECT_EQ(Warnings(report)[0],
            "force limits not found in the hand model for 1 of 2 actuators, treated as "
            "unlimited; largest torque 1.17 N·m");
}

TEST(HandLimitsTest, GeometryThatIsInTheObjectWhereASphereTouchesIsNamed) {
  Report report = HandReport(1, 1);
  report.steps[0].replay->hand->covered_depth_m = 9e-4;
  EXPECT_THAT(Warnings(report), IsEmpty());
  report.steps[0].replay->hand->covered_depth_m = 2.8e-3;
  ASSERT_THAT(Warnings(report), SizeIs(1));
  EXPECT_THAT(Warnings(report)[0], HasSubstr("up to 2.8 mm inside the object"));
}

TEST(HandLimitsTest, AReplayByPointsHasNoLimits) {
  Report report = HandReport(kUnlimited, kUnlimited);
  report.settings->hand.reset();
  EXPECT_THAT(Warnings(report), IsEmpty());
  EXPECT_THAT(FormatReportTable(report), Not(HasSubstr("limits:")));
  EXPECT_THAT(PageOf(report), Not(HasSubstr("Limits that")));
}

}  // namespace hand_limits_test
}  // namespace regrasp::report
