#include "planner/kinematics/hand_visuals.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace regrasp::kinematics {
namespace hand_visuals_test {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

/// Return a hand with one finger: two parallel joints 0.04 m apart; the second follows the first
/// with a ratio of 0.5 and an offset of 0.3 rad.
HandModel CoupledFinger() {
  Joint first;
  Joint second;
  second.offset = {0, 0, 0.04};
  second.ratio = 0.5;
  second.coupling_offset = 0.3;
  second.follows = true;
  for (Joint* joint : {&first, &second}) joint->axis = Vector3d::UnitX();
  Finger finger;
  finger.joints = {first, second};
  finger.drives = 1;
  HandModel hand;
  hand.fingers = {finger};
  return hand;
}

LinkVisual LinkAfter(int joints) {
  LinkVisual link;
  link.finger = FingerIndex(0);
  link.after = joints;
  return link;
}

TEST(HandVisuals, LinkPoseHasTheAnglesOfCoupledJoints) {
  const HandModel hand = CoupledFinger();
  const double angle = 0.8;
  const std::vector<std::vector<double>> joints = {{angle, 0.5 * angle + 0.3}};
  const Eigen::Isometry3d first = LinkPose(LinkAfter(1), hand, joints);
  const Eigen::Isometry3d second = LinkPose(LinkAfter(2), hand, joints);
  const Eigen::Matrix3d turn = AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_TRUE(first.linear().isApprox(turn, 1e-12));
  EXPECT_TRUE(second.translation().isApprox(turn * Vector3d(0, 0, 0.04), 1e-12));
  const double sum = angle + joints[0][1];
  EXPECT_TRUE(
      second.linear().isApprox(AngleAxisd(sum, Vector3d::UnitX()).toRotationMatrix(), 1e-12));
}

TEST(HandVisuals, ThePalmDoesNotMove) {
  EXPECT_TRUE(LinkPose(LinkVisual(), CoupledFinger(), {{0.8, 0.7}})
                  .isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace hand_visuals_test
}  // namespace regrasp::kinematics
