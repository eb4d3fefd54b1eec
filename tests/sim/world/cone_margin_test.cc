#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "sim/world/motion_monitor.h"

namespace regrasp::sim {
namespace cone_margin_test {

using Eigen::Vector3d;

TEST(ConeMarginTest, IsTheFrictionAngleLessTheAngleToTheNormal) {
  const Vector3d up = Vector3d::UnitZ();
  EXPECT_NEAR(ConeMargin({0, 0, 3}, up, Radians(20)), Radians(20), 1e-12);
  EXPECT_NEAR(ConeMargin({3, 0, 3}, up, Radians(50)), Radians(5), 1e-12);
  EXPECT_NEAR(ConeMargin({0, -3, 3}, up, Radians(45)), 0, 1e-12);
  EXPECT_NEAR(ConeMargin({0, 0, -1}, up, Radians(45)), Radians(-135), 1e-12);
}

TEST(ConeMarginTest, OfAFingerTheSmallestStaysAndOfAllTheSmallestIsNamed) {
  FingerMargins margins;
  EXPECT_FALSE(SmallestMargin(margins));
  EXPECT_EQ(FingerOfSmallestMargin(margins), -1);
  AddMargin(FingerIndex(4), 0.3, margins);
  AddMargin(FingerIndex(2), 0.2, margins);
  AddMargin(FingerIndex(4), 0.1, margins);
  AddMargin(FingerIndex(4), 0.4, margins);
  EXPECT_EQ(margins.size(), 2u);
  EXPECT_EQ(SmallestMargin(margins), 0.1);
  EXPECT_EQ(FingerOfSmallestMargin(margins), 4);
}

}  // namespace cone_margin_test
}  // namespace regrasp::sim
