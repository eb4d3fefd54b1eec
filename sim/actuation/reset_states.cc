#include "sim/actuation/reset_states.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/grasp/grasp_forces.h"
#include "sim/actuation/torque_squeeze.h"
#include "sim/scene/engine.h"
#include "sim/scene/scaling.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::Reason;

int StepsIn(double seconds, const HandWorld& world) {
  return static_cast<int>(std::lround(seconds / world.timestep()));
}

Isometry3d PoseOf(const ResetState& state) {
  const Eigen::Vector4d& q = state.quaternion;
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = state.position;
  pose.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  return pose;
}

/// What is allowed at rest.
HandTolerance AtRest(HandTolerance tolerance) {
  tolerance.length_m *= tolerance.at_rest;
  tolerance.angle_rad *= tolerance.at_rest;
  return tolerance;
}

}  // namespace

ResetStates::ResetStates(const kinematics::HandFile& file, const object::Polyhedron& solid,
                         double scale, const ResetStateOptions& options)
    : solid_(solid),
      scale_(scale),
      options_(options),
      weight_N_(options.mass_kg * kGravity),
      world_(file, solid, scale,
             {options.friction_factor * std::tan(options.half_angle), options.mass_kg, kGravity}),
      fresh_(world_, solid, scale, AtRest(options.tolerance)),
      judge_(fresh_) {
  const std::vector<std::string> names = world_.joint_names();
  for (const kinematics::Finger& finger : world_.hand().fingers) {
    std::vector<int>& places = joints_.emplace_back();
    for (const kinematics::Joint& joint : finger.joints) {
      places.push_back(static_cast<int>(std::ranges::find(names, joint.name) - names.begin()));
    }
  }
}

std::optional<double> ResetStates::SqueezeOf(const plan::HandState& rest,
                                             const plan::FingerGrasp& grasp) {
  const double squeeze = options_.squeeze_N
                             ? *options_.squeeze_N
                             : RestSqueeze(world_, solid_, scale_, rest, grasp, options_.half_angle,
                                           weight_N_, MostSqueeze(weight_N_));
  const Vector3d down = -weight_N_ * (rest.pose.linear().transpose() * world_.hand().up);
  const grasp::GraspForces forces =
      grasp::ComputeGraspForces(plan::ContactsOf(grasp), solid_.wrench_frame(), options_.half_angle,
                                {down, Vector3d::Zero()}, squeeze);
  return forces.balanced ? std::optional(squeeze) : std::nullopt;
}

std::variant<ResetState, Reason> ResetStates::Make(const plan::HandState& rest,
                                                   const plan::FingerGrasp& grasp,
                                                   double squeeze_N) {
  judge_.CopyState(fresh_);
  try {
    TakeHold(rest, grasp, squeeze_N);
  } catch (const UnstableError&) {
    return Reason::kSimulationUnstable;
  }
  if (const auto failure = Failure()) return *failure;
  ResetState state = Store(grasp, squeeze_N);
  if (const auto failure = Validate(state)) return *failure;
  return state;
}

void ResetStates::TakeHold(const plan::HandState& rest, const plan::FingerGrasp& grasp,
                           double squeeze_N) {
  world_.Place(rest);
  // The hand need not know where the object is: what it comes to rest at is what is stored.
  HandControl control(world_, solid_, scale_, {options_.half_angle, squeeze_N, weight_N_, false});
  Hold hold;
  for (const plan::FingerContact& held : grasp) {
    control.Attach(held.finger);
    hold.fingers.push_back(held.finger);
  }
  // Something holds the object until the fingers do.
  world_.PinObject(true);
  const int taking = StepsIn(kTakeHold, world_);
  for (int i = 1; i <= taking; ++i) {
    control.SetHolding({hold, hold, 1, static_cast<double>(i) / taking});
    control.Step();
  }
  world_.PinObject(false);
  for (const FingerIndex f : hold.fingers) judge_.SetHolding(f, true);
  for (int i = StepsIn(kSettle, world_); i > 0 && !Failure(); --i) {
    control.Step();
    judge_.Watch(rest.pose);
  }
}

std::optional<Reason> ResetStates::Failure() const {
  if (!judge_.breach()) return std::nullopt;
  return judge_.breach()->reason;
}

ResetState ResetStates::Store(const plan::FingerGrasp& grasp, double squeeze_N) const {
  ResetState state;
  state.joints = world_.joint_angles();
  state.controls = world_.controls();
  const Isometry3d pose = world_.object_pose();
  state.position = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  state.quaternion = {q.w(), q.x(), q.y(), q.z()};
  state.squeeze_N = squeeze_N;
  state.tips.resize(world_.hand().fingers.size());
  for (const plan::FingerContact& held : grasp) {
    const TipTouch touch = world_.touch(held.finger);
    state.tips[held.finger] = {true, touch.point_O, pose.linear().transpose() * touch.force};
  }
  return state;
}

plan::HandState ResetStates::StateOf(const ResetState& state) const {
  plan::HandState placed{PoseOf(state), {}};
  for (const std::vector<int>& places : joints_) {
    std::vector<double>& finger = placed.joints.emplace_back();
    for (const int joint : places) finger.push_back(state.joints[joint]);
  }
  return placed;
}

std::optional<Reason> ResetStates::Validate(ResetState& state) {
  const Isometry3d pose = PoseOf(state);
  world_.PinObject(false);
  world_.Place(StateOf(state));
  world_.SetControls(state.controls);
  state.qpos = world_.Save().engine.qpos;
  judge_.CopyState(fresh_);
  for (FingerIndex f{0}; f < std::ssize(state.tips); ++f) judge_.SetHolding(f, state.tips[f].holds);
  try {
    for (int i = StepsIn(kHeld, world_); i > 0 && !Failure(); --i) {
      world_.Step();
      judge_.Watch(pose);
    }
  } catch (const UnstableError&) {
    return Reason::kSimulationUnstable;
  }
  state.off_m = judge_.measures().off_m;
  state.off_rad = judge_.measures().off_rad;
  return Failure();
}

}  // namespace regrasp::sim
