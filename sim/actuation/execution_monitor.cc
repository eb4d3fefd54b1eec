#include "sim/actuation/execution_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/base/number.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/object/rotation.h"
#include "sim/hand/hand_finding.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::Reason;

/// Time between two checks of the links, seconds.
constexpr double kLinkPeriod = 0.01;
/// Least force of a finger that holds, newtons.
constexpr double kNoForce = 1e-3;
/// Share of a force limit that counts as the limit.
constexpr double kAtLimit = 0.999;
/// Allowed depth of the collision geometry of a fingertip that a sphere replaces, over the radius.
/// The sphere is fitted into the geometry.
constexpr double kCoveredDepth = 0.5;
/// Largest depth beyond the limit that is measured, metres.
constexpr double kDeepestMeasured = 0.02;

}  // namespace

ExecutionMonitor::ExecutionMonitor(const HandEngine& world, const object::Polyhedron& solid,
                                   double scale, const HandTolerance& tolerance)
    : world_(world),
      object_(std::make_shared<const Penetration>(solid, scale)),
      tolerance_(tolerance) {
  for (const kinematics::Finger& finger : world.hand().fingers) {
    fingers_.push_back({});
    fingers_.back().at_limit.assign(finger.drives, 0);
    fingers_.back().control_limit.assign(finger.drives, 0);
  }
}

void ExecutionMonitor::Start() {
  measures_ = {};
  violation_.reset();
  for (Finger& finger : fingers_) {
    std::ranges::fill(finger.at_limit, 0);
    std::ranges::fill(finger.control_limit, 0);
  }
}

void ExecutionMonitor::CopyState(const ExecutionMonitor& other) {
  phase_ = other.phase_;
  disturbance_ = other.disturbance_;
  fingers_ = other.fingers_;
  measures_ = other.measures_;
  violation_ = other.violation_;
  steps_ = other.steps_;
  settling_ = other.settling_;
}

void ExecutionMonitor::WatchContacts(const plan::FingerGrasp& grasp, double scale,
                                     double known_off) {
  for (const plan::FingerContact& held : grasp) {
    // Contacts are planned for spheres. Fingertips of other shapes touch at other points.
    const std::optional<collision::NearPoint> near = world_.NearBall(held.finger);
    const double radius = world_.hand().fingers[held.finger].tip.radius;
    double off = std::numeric_limits<double>::infinity();
    if (near) off = (near->point - scale * held.contact.p).norm();
    if (near && world_.tip_shape() == TipShape::kBall) {
      off = std::max(off, std::abs(near->distance - radius));
    }
    // A hand places a fingertip only as well as it measures its joints.
    const Vector3d measured = kinematics::TipAt(world_.hand().fingers[held.finger],
                                                world_.measured_configuration(held.finger))
                                  .centre;
    const double unknown = (measured - world_.tip(held.finger)).norm();
    if (off <= tolerance_.slip_m + known_off + unknown) continue;
    const std::string how = std::isfinite(off) ? FormatLength(off) + " from" : "far from";
    const int joints = static_cast<int>(world_.hand().fingers[held.finger].joints.size());
    Fail(Reason::kContactLost,
         FingerText(world_.hand(), held.finger) + " is " + how + " its contact",
         {how, {held.finger}, {{held.finger, joints}}, world_.tip(held.finger)});
  }
}

void ExecutionMonitor::SetHolding(FingerIndex finger, bool holds) {
  Finger& state = fingers_[finger];
  state.holds = holds;
  state.slides_to_O.reset();
  state.without_force = 0;
  state.slip.setZero();
  state.first_O = world_.touch(finger).point_O;
}

void ExecutionMonitor::SetSliding(FingerIndex finger, const Vector3d& centre_O) {
  fingers_[finger].slides_to_O = centre_O;
}

void ExecutionMonitor::Fail(Reason reason, const std::string& what, Marks marks) {
  if (violation_) return;
  Violation& violation = violation_.emplace();
  violation.reason = reason;
  violation.detail = what + (phase_.empty() ? "" : " " + phase_);
  violation.fault.fingers = std::move(marks.fingers);
  violation.fault.disturbance = disturbance_;
  plan::HandFaultPlace& place = violation.fault.hand.emplace();
  place.state = world_.state();
  place.links = std::move(marks.links);
  place.number = std::move(marks.number);
  place.at = marks.at;
  place.pose = marks.pose;
}

void ExecutionMonitor::WatchObject(const Isometry3d& planned, double share, double& off_m,
                                   double& off_rad) {
  const Isometry3d pose = world_.object_pose();
  const Vector3d& centre = world_.centroid_O();
  const double off = (pose * centre - planned * centre).norm();
  const double turned = object::RotationInBody(pose.linear(), planned.linear()).angle();
  off_m = std::max(off_m, off);
  off_rad = std::max(off_rad, turned);
  const double most_m = share * tolerance_.length_m;
  const double most_rad = share * tolerance_.angle_rad;
  if (off <= most_m && turned <= most_rad) return;
  const bool by_length = off / most_m >= turned / most_rad;
  const std::string number =
      by_length ? FormatLength(off, 2) + " off" : FormatDegrees(Degrees(turned)) + " off";
  const auto [value, limit] = by_length
                                  ? FormatLengthWithLimit(off, most_m)
                                  : FormatDegreesWithLimit(Degrees(turned), Degrees(most_rad));
  Fail(Reason::kObjectMoved,
       "the object is " + value + " from its planned pose, limit " + limit + ",",
       {.number = number, .pose = planned});
}

void ExecutionMonitor::WatchFrozen(const Isometry3d& start) {
  const Isometry3d pose = world_.object_pose();
  const Vector3d& centre = world_.centroid_O();
  const double turned = object::RotationInBody(pose.linear(), start.linear()).angle();
  measures_.frozen_off_m =
      std::max(measures_.frozen_off_m, (pose * centre - start * centre).norm());
  measures_.frozen_off_rad = std::max(measures_.frozen_off_rad, turned);
}

void ExecutionMonitor::CheckFrozen(const Isometry3d& start) {
  const double share_m = measures_.frozen_off_m / tolerance_.frozen_m;
  const double share_rad = measures_.frozen_off_rad / tolerance_.frozen_rad;
  if (std::max(share_m, share_rad) <= 1) return;
  const bool by_length = share_m >= share_rad;
  const double degrees = Degrees(measures_.frozen_off_rad);
  const std::string number =
      (by_length ? FormatLength(measures_.frozen_off_m, 2) : FormatDegrees(degrees)) + " off";
  const auto [value, limit] =
      by_length ? FormatLengthWithLimit(measures_.frozen_off_m, tolerance_.frozen_m)
                : FormatDegreesWithLimit(degrees, Degrees(tolerance_.frozen_rad));
  Fail(Reason::kNotStatic,
       "the object moves " + value + " within a second under constant controls, limit " + limit +
           ",",
       {.number = number, .pose = start});
}

void ExecutionMonitor::WatchContact(FingerIndex f) {
  Finger& state = fingers_[f];
  const double dt = world_.timestep();
  const TipTouch touch = world_.touch(f);
  state.without_force = touch.force.norm() > kNoForce ? 0 : state.without_force + dt;
  if (std::isfinite(touch.gap) && !settling_) {
    measures_.tip_depth_m = std::max(measures_.tip_depth_m, -touch.gap);
  }
  double slip = 0;
  if (state.slides_to_O) {
    const Vector3d off = world_.object_pose().inverse() * world_.tip(f) - *state.slides_to_O;
    slip = (off - off.dot(touch.inward_O) * touch.inward_O).norm();
  } else {
    state.slip += dt * touch.sliding_O;
    slip = state.slip.norm();
    if (std::isfinite(touch.gap)) {
      measures_.roll_m = std::max(measures_.roll_m, (touch.point_O - state.first_O).norm());
    }
  }
  measures_.slip_m = std::max(measures_.slip_m, slip);
  if (state.without_force <= tolerance_.lost_s && slip <= tolerance_.slip_m) return;
  const std::string name = FingerText(world_.hand(), f);
  const int joints = static_cast<int>(world_.hand().fingers[f].joints.size());
  if (state.without_force > tolerance_.lost_s) {
    Fail(Reason::kContactLost, name + " loses its contact",
         {"no force", {f}, {{f, joints}}, world_.tip(f)});
  } else {
    const std::string how = state.slides_to_O ? " off its path" : " slipped";
    const auto [value, limit] = FormatLengthWithLimit(slip, tolerance_.slip_m);
    Fail(Reason::kSlipped,
         name + (state.slides_to_O ? " is " + value + " off its path" : " slips " + value) +
             ", limit " + limit + ",",
         {FormatLength(slip, 2) + how, {f}, {{f, joints}}, world_.tip(f)});
  }
}

void ExecutionMonitor::WatchFinger(FingerIndex f) {
  if (fingers_[f].holds) WatchContact(f);
  WatchActuators(f);
}

void ExecutionMonitor::WatchActuators(FingerIndex f) {
  Finger& state = fingers_[f];
  const double dt = world_.timestep();
  for (std::size_t drive = 0; drive < state.at_limit.size(); ++drive) {
    const int d = static_cast<int>(drive);
    const double share = world_.load_share(f, d);
    measures_.torque_share = std::max(measures_.torque_share, share);
    measures_.torque_Nm = std::max(measures_.torque_Nm, std::abs(world_.torque(f, d)));
    if (world_.is_control_at_limit(f, d)) state.control_limit[drive] += dt;
    measures_.control_limit_s = std::max(measures_.control_limit_s, state.control_limit[drive]);
    double& seconds = state.at_limit[drive];
    seconds = share >= kAtLimit ? seconds + dt : 0;
    if (seconds <= tolerance_.limit_s) continue;
    const kinematics::Finger& chain = world_.hand().fingers[f];
    const auto joint =
        std::ranges::find(chain.joints, static_cast<int>(drive), &kinematics::Joint::drive);
    const std::string limit = FormatShort(world_.servo(f, d).limit, 3) + " N·m";
    Fail(Reason::kTorqueLimit,
         "the actuator of joint " + joint->name + " of " + FingerText(world_.hand(), f) +
             " is at its limit of " + limit + " for longer than " +
             FormatShort(1e3 * tolerance_.limit_s) + " ms",
         MarksOfJoint(f, static_cast<int>(joint - chain.joints.begin()), limit));
  }
}

ExecutionMonitor::Marks ExecutionMonitor::MarksOfJoint(FingerIndex f, int joint,
                                                       std::string number) const {
  const kinematics::Finger& chain = world_.hand().fingers[f];
  return {std::move(number),
          {f},
          {{f, joint + 1}},
          kinematics::FramesOf(chain, world_.configuration(f))[joint].translation()};
}

void ExecutionMonitor::WatchJoints(FingerIndex f) {
  const kinematics::Finger& chain = world_.hand().fingers[f];
  const std::vector<double> angles = world_.joint_angles_of(f);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const kinematics::Joint& joint = chain.joints[k];
    const double outside = std::max(joint.lower - angles[k], angles[k] - joint.upper);
    if (outside <= tolerance_.joint_rad) continue;
    const std::string number = FormatDegrees(Degrees(outside));
    Fail(Reason::kJointLimit,
         "joint " + joint.name + " of " + FingerText(world_.hand(), f) + " is " + number +
             " outside its range, limit " + FormatDegrees(Degrees(tolerance_.joint_rad)) + ",",
         MarksOfJoint(f, static_cast<int>(k), number + " outside"));
  }
}

void ExecutionMonitor::WatchCouplings() {
  const auto [equality, residual] = world_.largest_coupling_residual();
  measures_.coupling_rad = std::max(measures_.coupling_rad, residual);
  if (equality < 0 || residual <= tolerance_.joint_rad) return;
  const std::string number = FormatDegrees(Degrees(residual)) + " off";
  const auto [finger, joint] = world_.JointOfCoupling(equality);
  Fail(Reason::kCouplingViolated,
       world_.CouplingText(equality) + " is " + FormatDegrees(Degrees(residual)) +
           " off its coupling, limit " + FormatDegrees(Degrees(tolerance_.joint_rad)) + ",",
       finger.valid() ? MarksOfJoint(finger, joint, number) : Marks{number});
}

std::vector<HandLinks::Placed> ExecutionMonitor::PlaceLinks() const {
  std::vector<kinematics::JointConfiguration> configurations;
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f)
    configurations.push_back(world_.configuration(f));
  return world_.links().Place(world_.hand(), configurations);
}

std::string ExecutionMonitor::LinkText(const HandLinks::Placed& placed) const {
  const FingerIndex f = placed.link->finger;
  return placed.link->link + " of " + (f.valid() ? FingerText(world_.hand(), f) : "the palm");
}

ExecutionMonitor::Marks ExecutionMonitor::MarksOf(
    std::initializer_list<const HandLinks::Placed*> links) {
  Marks marks{"touch"};
  Vector3d sum = Vector3d::Zero();
  for (const HandLinks::Placed* placed : links) {
    const FingerIndex f = placed->link->finger;
    marks.links.push_back({f, placed->link->after});
    sum += placed->sphere.centre;
    if (f.valid() && std::ranges::find(marks.fingers, f) == marks.fingers.end()) {
      marks.fingers.push_back(f);
    }
  }
  marks.at = sum / static_cast<double>(links.size());
  return marks;
}

void ExecutionMonitor::WatchLinks() {
  const Isometry3d to_object = world_.object_pose().inverse();
  const std::vector<HandLinks::Placed> placed = PlaceLinks();
  for (const HandLinks::Placed& one : placed) {
    if (one.link->role != HandLinks::Role::kLink ||
        object_->surface().IsApart(collision::Moved(to_object, one), 0)) {
      continue;
    }
    Fail(Reason::kHandCollides, LinkText(one) + " touches the object", MarksOf({&one}));
  }
  for (auto a = placed.begin(); a != placed.end(); ++a) {
    for (auto b = a + 1; b != placed.end(); ++b) {
      if (world_.links().MayTouch(*a, *b) || collision::AreApart(*a, *b, 0)) continue;
      Fail(Reason::kHandCollides, LinkText(*a) + " touches " + LinkText(*b), MarksOf({&*a, &*b}));
    }
  }
  WatchTips(placed);
}

void ExecutionMonitor::WatchTips(const std::vector<HandLinks::Placed>& placed) {
  const bool is_ball = world_.tip_shape() == TipShape::kBall;
  if (is_ball) {
    for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
      const double radius = world_.hand().fingers[f].tip.radius;
      WatchDepth(f, {{world_.tip(f)}, radius}, tolerance_.depth_m, "the fingertip sphere");
    }
  }
  for (const HandLinks::Placed& one : placed) {
    if (one.link->role != HandLinks::Role::kCovered) continue;
    const FingerIndex f = one.link->finger;
    if (is_ball) {
      const double allowed = kCoveredDepth * world_.hand().fingers[f].tip.radius;
      WatchDepth(f, ShapeOf(one), std::max(allowed, tolerance_.depth_m),
                 "the collision geometry of body " + one.link->link);
    } else if (!settling_) {
      WatchDepth(f, ShapeOf(one), tolerance_.depth_m, "body " + one.link->link);
    }
  }
}

void ExecutionMonitor::WatchDepth(FingerIndex f, const collision::ConvexShape& shape,
                                  double allowed, const std::string& what) {
  const collision::ConvexShape placed = collision::Moved(world_.object_pose().inverse(), shape);
  const Vector3d outward = -world_.touch(f).inward_O;
  if (!object_->IsDeeper(placed, allowed, outward)) return;
  const double depth = object_->Depth(placed, allowed + kDeepestMeasured, outward);
  const std::string text = FormatLength(depth);
  const int joints = static_cast<int>(world_.hand().fingers[f].joints.size());
  Fail(Reason::kTipPenetrates,
       what + " of " + FingerText(world_.hand(), f) + " is " + text + " inside the object, limit " +
           FormatLength(allowed) + ",",
       {text + " inside", {f}, {{f, joints}}, world_.tip(f)});
}

void ExecutionMonitor::WatchTipsAtRest() {
  const std::vector<HandLinks::Placed> placed = PlaceLinks();
  WatchTips(placed);
  if (world_.tip_shape() != TipShape::kBall) return;
  const Isometry3d to_object = world_.object_pose().inverse();
  for (const HandLinks::Placed& one : placed) {
    if (one.link->role != HandLinks::Role::kCovered) continue;
    const Vector3d outward = -world_.touch(one.link->finger).inward_O;
    const double depth =
        object_->Depth(collision::Moved(to_object, ShapeOf(one)), kDeepestMeasured, outward);
    measures_.covered_depth_m = std::max(measures_.covered_depth_m, depth);
  }
}

void ExecutionMonitor::WatchPlaced(FingerIndex f) {
  if (std::isfinite(world_.touch(f).gap)) return;
  const int joints = static_cast<int>(world_.hand().fingers[f].joints.size());
  Fail(Reason::kContactLost, FingerText(world_.hand(), f) + " does not reach the object",
       {"not reached", {f}, {{f, joints}}, world_.tip(f)});
}

void ExecutionMonitor::Watch(const Isometry3d& planned) {
  measures_.simulated_s += world_.timestep();
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) WatchFinger(f);
  WatchCouplings();
  const int period = static_cast<int>(std::lround(kLinkPeriod / world_.timestep()));
  if (steps_++ % std::max(1, period) == 0) {
    for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) WatchJoints(f);
    WatchLinks();
  }
  WatchObject(planned, 1, measures_.off_m, measures_.off_rad);
}

void ExecutionMonitor::WatchRest(const Isometry3d& planned) {
  WatchObject(planned, tolerance_.at_rest, measures_.rest_off_m, measures_.rest_off_rad);
}

}  // namespace regrasp::sim
