#include "report/page/facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "sim/scene/scaling.h"

namespace regrasp::report {
namespace facts_test {

using testing::HasSubstr;
using testing::Not;

std::string FormatFacts(const Report& report) {
  return MakeFacts(report, MeasureSteps(report)).Format();
}

TEST(FactsTest, SettingsAreToldOnlyOfAReplay) {
  Report report;
  report.object_file = "<cube>.obj";
  report.friction_angle = Radians(20);
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>&lt;cube&gt;.obj, a solid</dd>"));
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>20.00° (μ = 0.364)</dd>"));
  EXPECT_THAT(FormatFacts(report), Not(HasSubstr("Grasp force")));
  report.settings.emplace().grasp_force_N = 25;
  report.settings->mass_kg = 2.5 / sim::kGravity;
  EXPECT_THAT(FormatFacts(report),
              HasSubstr("<dt>Grasp force</dt><dd>25 N, 10 times the weight: "));
}

TEST(FactsTest, TheWeakestStepIsNamedWithWhatItHasToSpare) {
  Report report;
  report.friction_angle = Radians(20);
  for (const double required_deg : {12.0, 17.0}) {
    ReportStep& step = report.steps.emplace_back();
    step.check.index = plan::EntryIndex(static_cast<int>(report.steps.size()) - 1);
    step.check.required =
        grasp::RequiredFrictionAngle{Radians(required_deg), Radians(required_deg)};
  }
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>step 1, 3.00° margin</dd>"));
  // If a step failed, the margin of another step is not reported as the weakest.
  report.steps.emplace_back().check.reason = plan::Reason::kNotForceClosure;
  EXPECT_THAT(FormatFacts(report), Not(HasSubstr("° margin")));
}

TEST(FactsTest, TheProgramAndTheCommandAreTold) {
  Report report;
  EXPECT_THAT(FormatFacts(report), Not(HasSubstr("Command")));
  report.run = RunRecord{"", {}, "validate 1.2", "validate --object <cube>.obj"};
  EXPECT_THAT(FormatFacts(report), Not(HasSubstr("Validated on")));
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>validate 1.2</dd>"));
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dd>validate --object &lt;cube&gt;.obj</dd>"));
  report.run->date = "2026-02-28";
  EXPECT_THAT(FormatFacts(report), HasSubstr("<dt>Validated on</dt><dd>2026-02-28 (UTC)</dd>"));
}

}  // namespace facts_test
}  // namespace regrasp::report
