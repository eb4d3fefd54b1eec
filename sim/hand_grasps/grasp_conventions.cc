#include "sim/hand_grasps/grasp_conventions.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;

constexpr double kLargestRatio = 30;
constexpr double kSmallestRatio = 1.0 / 300;
constexpr double kThousand = 1000;
/// Largest depth of a grasp that is read correctly, metres.
constexpr double kPlausibleDepth = 5e-3;

bool IsPlausible(double ratio) { return ratio <= kLargestRatio && ratio >= kSmallestRatio; }

/// Return the pose whose quaternion was read in the order x, y, z, w.
Isometry3d WithScalarLast(const Isometry3d& pose) {
  const Quaterniond read(pose.linear());
  Isometry3d result = pose;
  result.linear() = Quaterniond(read.z(), read.w(), read.x(), read.y()).toRotationMatrix();
  return result;
}

bool TouchesAt(const Isometry3d& palm, const HandGrasp& grasp, const GraspGeometry& geometry,
               GraspWorld& world) {
  HandConfiguration configuration = grasp.grasp;
  configuration.palm = palm;
  world.Place(configuration);
  const double distance = SmallestDistance(geometry.Measure(world));
  return distance <= GraspGeometry::kContactDistance && distance >= -kPlausibleDepth;
}

void CheckDegrees(const HandGrasp& grasp, const GraspWorld& world, const std::string& where) {
  for (const GraspWorld::JointRange& joint : world.joints()) {
    const auto found = grasp.grasp.joints.find(joint.name);
    if (found == grasp.grasp.joints.end() || joint.slides || !joint.limited) continue;
    const double value = found->second;
    const double outside = std::max(value - joint.upper, joint.lower - value);
    if (outside < 2 * std::numbers::pi) continue;
    throw InputError(where + ": /joints/" + joint.name + ": outside its range, expected " +
                     FormatShort(joint.lower) + " to " + FormatShort(joint.upper) + " rad, found " +
                     FormatShort(value) + "; help: convert degrees to radians");
  }
}

}  // namespace

void CheckGraspScale(const HandGrasp& grasp, const WholeHand& hand, const object::Object& object,
                     const std::string& where) {
  const double size = object.diameter() * grasp.scale;
  const double ratio = size / hand.length;
  if (IsPlausible(ratio)) return;
  std::string help;
  for (const double factor : {1 / kThousand, kThousand}) {
    if (!IsPlausible(ratio * factor)) continue;
    help = "; help: a scale of " + FormatShort(grasp.scale * factor) + " gives " +
           FormatLength(size * factor);
  }
  throw InputError(where + ": /object/scale: size of the object not plausible for a hand of " +
                   FormatLength(hand.length) + ", found " + FormatLength(size) + help);
}

void CheckGraspConventions(const HandGrasp& grasp, const WholeHand& hand,
                           const object::Object& object, const GraspWorld& world,
                           const std::string& where) {
  const std::vector<std::pair<const HandConfiguration*, std::string>> configurations = {
      {&grasp.grasp, where},
      {grasp.pregrasp ? &*grasp.pregrasp : nullptr, where + ": /pregrasp"},
      {grasp.target ? &*grasp.target : nullptr, where + ": /target"}};
  for (const auto& [configuration, name] : configurations) {
    if (configuration != nullptr) world.CheckJoints(*configuration, name);
  }
  static_cast<void>(world.Closed(grasp.grasp, grasp.closing, where + ": /closing"));
  CheckDegrees(grasp, world, where);
  const double size = object.diameter() * grasp.scale;
  const double distance = (grasp.grasp.palm.translation() - world.centroid()).norm();
  if (distance - size <= hand.length) return;
  const bool metres = distance / kThousand - size <= hand.length;
  throw InputError(where + ": /palm/position: too far from the object, expected at most " +
                   FormatLength(size + hand.length) + ", found " + FormatLength(distance) +
                   (metres ? "; help: convert millimetres to metres" : ""));
}

std::string LikelyConvention(const HandGrasp& grasp, const GraspGeometry& geometry,
                             GraspWorld& world) {
  const Isometry3d& palm = grasp.grasp.palm;
  if (TouchesAt(WithScalarLast(palm), grasp, geometry, world)) {
    return "quaternions in the order x, y, z, w";
  }
  if (TouchesAt(palm.inverse(), grasp, geometry, world)) {
    return "poses of the object in the frame of the palm";
  }
  return "";
}

}  // namespace regrasp::sim
