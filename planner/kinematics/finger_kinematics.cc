#include "planner/kinematics/finger_kinematics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace regrasp::kinematics {
namespace {

using Eigen::Vector3d;

double AngleOf(const Joint& joint, const JointConfiguration& configuration) {
  return joint.ratio * configuration[joint.drive] + joint.coupling_offset;
}

Eigen::Matrix3d TurnOf(const Joint& joint, const JointConfiguration& configuration) {
  return Eigen::AngleAxisd(AngleOf(joint, configuration) - joint.rest, joint.axis)
      .toRotationMatrix();
}

}  // namespace

const Joint& LeadingJoint(const Finger& finger, int drive) {
  const auto leads = [&](const Joint& joint) { return joint.drive == drive && !joint.follows; };
  return *std::ranges::find_if(finger.joints, leads);
}

std::vector<double> JointAngles(const Finger& finger, const JointConfiguration& configuration) {
  std::vector<double> angles;
  angles.reserve(finger.joints.size());
  for (const Joint& joint : finger.joints) angles.push_back(AngleOf(joint, configuration));
  return angles;
}

JointConfiguration ConfigurationAt(const Finger& finger, const std::vector<double>& angles) {
  JointConfiguration configuration(finger.drives);
  for (std::size_t i = 0; i < finger.joints.size(); ++i) {
    const Joint& joint = finger.joints[i];
    if (!joint.follows) configuration[joint.drive] = DriveAngle(joint, angles[i]);
  }
  return configuration;
}

JointFrames FramesOf(const Finger& finger, const JointConfiguration& configuration) {
  JointFrames frames;
  frames.reserve(finger.joints.size());
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (const Joint& joint : finger.joints) {
    frame.translation() += frame.linear() * joint.offset;
    frame.linear() *= TurnOf(joint, configuration);
    frames.push_back(frame);
  }
  return frames;
}

TipState TipAt(const Finger& finger, const JointConfiguration& configuration) {
  std::array<Vector3d, kMostJoints> origins;
  std::array<Vector3d, kMostJoints> axes;
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  Vector3d origin = Vector3d::Zero();
  const int count = static_cast<int>(finger.joints.size());
  for (int i = 0; i < count; ++i) {
    const Joint& joint = finger.joints[i];
    origin += turned * joint.offset;
    turned = turned * TurnOf(joint, configuration);
    origins[i] = origin;
    axes[i].noalias() = turned * joint.axis;
  }
  TipState state;
  state.centre = origin + turned * finger.tip.centre;
  state.axis = turned * finger.tip.axis;
  state.jacobian.setZero(3, finger.drives);
  for (int i = 0; i < count; ++i) {
    const Joint& joint = finger.joints[i];
    state.jacobian.col(joint.drive) += joint.ratio * axes[i].cross(state.centre - origins[i]);
  }
  return state;
}

double MotionBound(const Finger& finger, const JointConfiguration& from,
                   const JointConfiguration& to, int after, const std::vector<double>& reach) {
  double bound = 0;
  for (int i = 0; i < after; ++i) {
    const Joint& joint = finger.joints[i];
    bound += std::abs(joint.ratio * (to[joint.drive] - from[joint.drive])) * reach[i];
  }
  return bound;
}

std::vector<double> LinkReach(const Finger& finger, const LinkShape& shape) {
  double farthest = 0;
  for (const Vector3d& point : shape.shape.points) farthest = std::max(farthest, point.norm());
  farthest += shape.shape.radius;
  std::vector<double> reach(shape.after);
  for (int i = shape.after - 1; i >= 0; --i) {
    reach[i] = farthest;
    farthest += finger.joints[i].offset.norm();
  }
  return reach;
}

double MaximumReach(const Finger& finger) {
  double reach = finger.tip.centre.norm() + finger.tip.radius;
  for (std::size_t i = 1; i < finger.joints.size(); ++i) reach += finger.joints[i].offset.norm();
  return reach;
}

}  // namespace regrasp::kinematics
