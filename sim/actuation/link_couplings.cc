#include "sim/actuation/link_couplings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <string>

#include "planner/base/error.h"

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;

/// Distance of a rod from axes that intersect, metres.
constexpr double kLeastDistance = 0.01;
/// Distance below which parallel axes coincide, metres, and sine of the angle below which axes are
/// parallel.
constexpr double kSameAxis = 1e-6;

/// Return the torque about an axis of a force at a point, as a vector: its scalar product with the
/// force is the torque.
Vector3d MomentOf(const JointAxis& joint, const Vector3d& point) {
  return joint.axis.cross(point - joint.anchor);
}

bool Coincide(const JointAxis& first, const JointAxis& second) {
  return first.axis.cross(second.axis).norm() < kSameAxis &&
         first.axis.cross(second.anchor - first.anchor).norm() < kSameAxis;
}

}  // namespace

std::vector<LinkCoupling> LinkCouplingsOf(const HandScene& scene, const LinkTree& tree) {
  std::vector<LinkCoupling> couplings;
  const std::vector<Eigen::Isometry3d> poses =
      tree.Place(Eigen::VectorXd::Zero(static_cast<int>(tree.links().size())));
  const auto axis_of = [&](int link) {
    const LinkTree::Link& made = tree.links()[link];
    return JointAxis{poses[link] * made.anchor, poses[link].linear() * made.axis};
  };
  for (FingerIndex f{0}; f < std::ssize(scene.hand.fingers); ++f) {
    const std::vector<kinematics::Joint>& joints = scene.hand.fingers[f].joints;
    for (std::size_t k = 1; k < joints.size(); ++k) {
      const auto same = [&](const kinematics::Joint& other) {
        return other.drive == joints[k].drive;
      };
      const auto end = joints.begin() + static_cast<std::ptrdiff_t>(k);
      if (std::none_of(joints.begin(), end, same)) continue;
      const kinematics::Joint& before = joints[k - 1];
      const int link = tree.link(f, k);
      if (!same(before)) {
        throw InputError("engine ode: joint " + before.name + " between coupled joints, before " +
                         joints[k].name + ", not supported");
      }
      if (Coincide(axis_of(tree.links()[link].parent), axis_of(link))) {
        throw InputError("engine ode: coupled joints " + before.name + " and " + joints[k].name +
                         " on one axis not supported");
      }
      couplings.push_back({link, joints[k].ratio / before.ratio});
    }
  }
  return couplings;
}

RodLine RodLineOf(const JointAxis& first, const JointAxis& second, double ratio) {
  const Vector3d between = second.anchor - first.anchor;
  const double distance = std::max(first.axis.cross(between).norm(), kLeastDistance);
  const Vector3d middle = (first.anchor + second.anchor) / 2;
  const Vector3d side = first.axis.unitOrthogonal();
  // On a line through both axes the torques depend on each other. One of three points is off it.
  Vector3d best = middle;
  Vector3d normal = Vector3d::Zero();
  for (const Vector3d& away : {first.axis, side, Vector3d(first.axis.cross(side))}) {
    const Vector3d point = middle + distance * away;
    const Vector3d both = MomentOf(first, point).cross(MomentOf(second, point));
    if (both.squaredNorm() <= normal.squaredNorm()) continue;
    best = point;
    normal = both;
  }
  // The force in the plane of both moments with the torques −ratio and 1.
  const Vector3d force =
      ratio * normal.cross(MomentOf(second, best)) + normal.cross(MomentOf(first, best));
  return {best, force.normalized()};
}

}  // namespace regrasp::sim
