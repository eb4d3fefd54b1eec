#include "check_expectations.h"

#include <gtest/gtest.h>

namespace regrasp::plan {

void ExpectFails(const PlanCheck& check, int index, Reason reason, const std::string& name) {
  SCOPED_TRACE(name);
  EXPECT_FALSE(check.passed());
  ASSERT_LT(index, std::ssize(check.steps));
  for (int k = 0; k < std::ssize(check.steps); ++k) {
    const StepCheck& step = check.steps[k];
    EXPECT_EQ(step.index, k);
    EXPECT_EQ(step.skipped, k > index);
    EXPECT_EQ(ReasonName(step.reason), ReasonName(k == index ? reason : Reason::kNone))
        << step.detail;
    EXPECT_EQ(step.detail.empty(), k != index);
  }
}

void ExpectPasses(const PlanCheck& check, const std::string& name) {
  SCOPED_TRACE(name);
  EXPECT_TRUE(check.passed());
  for (const StepCheck& step : check.steps) {
    EXPECT_EQ(ReasonName(step.reason), "") << step.index << ": " << step.detail;
    EXPECT_TRUE(step.force_closure);
    EXPECT_EQ(step.undecided, 0);
  }
}

}  // namespace regrasp::plan
