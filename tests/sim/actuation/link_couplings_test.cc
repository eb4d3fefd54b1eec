#include "sim/actuation/link_couplings.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace regrasp::sim {
namespace link_couplings_test {

using Eigen::Vector3d;

/// Return the velocity of a point of a link about a joint, per speed of the joint.
Vector3d VelocityAt(const Vector3d& point, const JointAxis& joint) {
  return joint.axis.cross(point - joint.anchor);
}

/// The velocity along the rod is c (second speed − ratio · first speed), with one c > 0.
void ExpectRod(const JointAxis& first, const JointAxis& second, double ratio) {
  const RodLine rod = RodLineOf(first, second, ratio);
  EXPECT_NEAR(rod.direction.norm(), 1, 1e-12);
  const double c = rod.direction.dot(VelocityAt(rod.point, second));
  // A short moment arm would make the rod's force large.
  EXPECT_GT(c, 1e-4);
  EXPECT_NEAR(rod.direction.dot(VelocityAt(rod.point, first)), -ratio * c, 1e-12);
}

TEST(LinkCouplingsTest, ARodImposesTheRatioOfTheSpeeds) {
  const Vector3d oblique = Vector3d(1, 2, -0.5).normalized();
  const JointAxis first{{0.01, -0.02, 0.03}, oblique};
  int checked = 0;
  for (const double ratio : {-2.0, -1.0, 0.2, 1.0, 3.0}) {
    for (const double distance : {0.002, 0.03}) {
      const Vector3d across = distance * oblique.unitOrthogonal();
      ExpectRod(first, {first.anchor + across, oblique}, ratio);
      ExpectRod(first, {first.anchor + across + 0.04 * oblique, oblique}, ratio);
      ExpectRod(first, {first.anchor + across, -oblique}, ratio);
      ExpectRod(first, {first.anchor + across, Vector3d(-0.3, 0.1, 1).normalized()}, ratio);
      checked += 4;
    }
    ExpectRod(first, {first.anchor, oblique.unitOrthogonal()}, ratio);
  }
  EXPECT_EQ(checked, 40);
}

}  // namespace link_couplings_test
}  // namespace regrasp::sim
