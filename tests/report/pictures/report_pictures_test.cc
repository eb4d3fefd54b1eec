#include "report/pictures/report_pictures.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/base/number.h"
#include "planner/plan/reason.h"
#include "report/report.h"

namespace regrasp::report {
namespace report_pictures_test {

/// Return a report of a plan that passes with a friction angle of 20°.
/// @param required_deg  required friction angle of each entry, degrees.
Report ReportWith(const std::vector<double>& required_deg) {
  Report report;
  report.friction_angle = Radians(20);
  for (const double angle : required_deg) {
    ReportStep& step = report.steps.emplace_back();
    step.check.index = plan::EntryIndex(static_cast<int>(report.steps.size()) - 1);
    step.check.kind = "switch";
    step.check.force_closure = true;
    step.check.required = grasp::RequiredFrictionAngle{Radians(angle), Radians(angle)};
  }
  return report;
}

std::vector<std::string> NotesOf(const Report& report) {
  std::vector<std::string> notes;
  for (const ReportStep& step : report.steps) notes.push_back(OverviewNote(report, step));
  return notes;
}

TEST(ReportPicturesTest, TheOverviewMarksTheStepWithTheSmallestFrictionMargin) {
  using Notes = std::vector<std::string>;
  EXPECT_EQ(NotesOf(ReportWith({12, 17.5, 15})),
            Notes({"", "smallest friction margin: 2.50°", ""}));
  EXPECT_EQ(NotesOf(ReportWith({19, 17.5, 15})),
            Notes({"smallest friction margin: 1.00°", "", ""}));
}

TEST(ReportPicturesTest, TheOverviewOfAPlanThatFailsMarksNoMargin) {
  Report report = ReportWith({12, 17.5, 15});
  report.steps[2].check.force_closure = false;
  report.steps[2].check.reason = plan::Reason::kNotForceClosure;
  EXPECT_EQ(NotesOf(report), std::vector<std::string>(3));
}

TEST(ReportPicturesTest, ASingleGraspHasNothingToCompare) {
  EXPECT_EQ(NotesOf(ReportWith({12})), std::vector<std::string>(1));
}

}  // namespace report_pictures_test
}  // namespace regrasp::report
