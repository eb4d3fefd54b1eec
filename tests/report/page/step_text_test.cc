#include <gtest/gtest.h>

#include "report/page/step_table.h"

namespace regrasp::report {
namespace step_text_test {

TEST(StepTextTest, OnlyAnAsciiLetterIsCapitalized) {
  EXPECT_EQ(Capitalized("slipped"), "Slipped");
  EXPECT_EQ(Capitalized("Slipped"), "Slipped");
  EXPECT_EQ(Capitalized("ε"), "ε");
  EXPECT_EQ(Capitalized(""), "");
}

TEST(StepTextTest, StepsCountFromTheHold) {
  EXPECT_EQ(StepName(plan::EntryIndex(0)), "the hold");
  EXPECT_EQ(StepName(plan::EntryIndex(3)), "step 3");
}

}  // namespace step_text_test
}  // namespace regrasp::report
