#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/repair/cgal_mesh.h"

namespace regrasp::repair {
namespace exact_point_test {

using Number = ExactKernel::FT;

/// Construct the intersection of a line with the plane z = 0 as the stages do.
ExactPoint Crossing(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Number t = Number(a.z()) / (Number(a.z()) - Number(b.z()));
  const auto at = [&](int axis) { return a[axis] + t * (Number(b[axis]) - Number(a[axis])); };
  return {at(0), at(1), at(2)};
}

Eigen::Vector3d Draw(RandomStream& random, double z) {
  return {random.Uniform(), random.Uniform(), z * (1 + random.Uniform())};
}

TEST(ExactPoint, IsRoundedTheSameWhateverItWasNeededForBefore) {
  RandomStream random(1, RandomUse::kContactPoints);
  int differ = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d a = Draw(random, 1), b = Draw(random, -1);
    const ExactPoint point = Crossing(a, b);
    const double before = CGAL::to_double(point.x());
    const Eigen::Vector3d rounded = Rounded(point);
    EXPECT_EQ(Rounded(point), rounded);
    EXPECT_EQ(Rounded(Crossing(a, b)), rounded);
    EXPECT_EQ(rounded.z(), 0);
    differ += CGAL::to_double(point.x()) != before;
  }
  // Control: CGAL::to_double of the same point has changed.
  EXPECT_GT(differ, 0);
}

}  // namespace exact_point_test
}  // namespace regrasp::repair
