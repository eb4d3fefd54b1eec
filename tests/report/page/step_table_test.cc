#include "report/page/step_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/number.h"

namespace regrasp::report {
namespace step_table_test {

using testing::HasSubstr;
using testing::Not;

std::string Format(const std::vector<Element>& elements) {
  return Element("main", {}, elements).Format();
}

/// Return a report of an initial grasp without replay.
Report MakeReport() {
  Report report;
  report.friction_angle = Radians(20);
  report.steps.emplace_back().check.required =
      grasp::RequiredFrictionAngle{Radians(12), Radians(12.5)};
  return report;
}

/// Return the step table of a report without images, and its note.
std::string TableOf(const Report& report) {
  return Format(MakeStepTable(report, plan::Plan(), MeasureSteps(report), {""}));
}

TEST(StepTableTest, OnlyAStepWithAPictureLinksToIt) {
  const Report report = MakeReport();
  const std::vector<StepMeasures> measures = MeasureSteps(report);
  EXPECT_THAT(Format(MakeStepTable(report, plan::Plan(), measures, {""})), Not(HasSubstr("<a")));
  EXPECT_THAT(Format(MakeStepTable(report, plan::Plan(), measures, {"frame0"})),
              HasSubstr("<a href=\"#frame0\">"));
}

TEST(StepTableTest, WhatWasNotReplayedHasNoMotion) {
  Report report = MakeReport();
  EXPECT_THAT(TableOf(report), HasSubstr("data-name=\"Slip\">–</td>"));
  EXPECT_THAT(TableOf(report), HasSubstr("12.50°"));
  report.steps[0].replay.emplace();
  EXPECT_THAT(TableOf(report), Not(HasSubstr("data-name=\"Slip\">–</td>")));
}

TEST(StepTableTest, TheNoteStatesWhatHoldsTheObjectAndWhatWasMeasured) {
  Report report = MakeReport();
  EXPECT_THAT(TableOf(report), HasSubstr("every grasp of the step is force closure."));
  EXPECT_THAT(TableOf(report), HasSubstr("and in the disturbance test after it."));
  report.steps[0].check.is_supported = true;
  report.settings.emplace().hand.emplace();
  EXPECT_THAT(TableOf(report), HasSubstr("is force closure or supported by gravity."));
  EXPECT_THAT(TableOf(report), Not(HasSubstr("disturbance test")));
}

TEST(FingerTableTest, AFingerThatTheOthersCannotDoWithoutSaysNone) {
  Report report = MakeReport();
  EXPECT_TRUE(MakeFingerTable(report).empty());
  report.grasp =
      GraspReport{{0.1, 0.1}, {{Radians(3), true, std::nullopt}, {Radians(11), true, Radians(30)}}};
  const std::string table = Format(MakeFingerTable(report));
  EXPECT_THAT(table, HasSubstr("<td class=\"number\">17.00°</td><td class=\"number\">none</td>"));
  EXPECT_THAT(table, HasSubstr("<td class=\"number\">9.00°</td><td class=\"number\">30.00°</td>"));
}

}  // namespace step_table_test
}  // namespace regrasp::report
