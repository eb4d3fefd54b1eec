#include "sim/actuation/reset_states.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "planner/base/in_blocks.h"
#include "planner/base/random.h"
#include "planner/base/zip_archive.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/plan/reason.h"
#include "sim/actuation/torque_grasp_force.h"
#include "sim/replay/trials.h"
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

/// Return the tolerance of a static grasp.
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
      world_(
          file, solid, scale,
          {options.friction_factor * std::tan(options.friction_angle), options.mass_kg, kGravity}),
      fresh_(world_, solid, scale, AtRest(options.tolerance)),
      monitor_(fresh_) {
  const std::vector<std::string> names = world_.joint_names();
  for (const kinematics::Finger& finger : world_.hand().fingers) {
    std::vector<int>& places = joints_.emplace_back();
    for (const kinematics::Joint& joint : finger.joints) {
      places.push_back(static_cast<int>(std::ranges::find(names, joint.name) - names.begin()));
    }
  }
}

std::optional<double> ResetStates::GraspForceOf(const plan::HandState& rest,
                                                const plan::FingerGrasp& grasp) {
  const double grasp_force =
      options_.grasp_force_N
          ? *options_.grasp_force_N
          : StaticGraspForce(world_, solid_, scale_, rest, grasp, options_.friction_angle,
                             weight_N_, LargestGraspForce(weight_N_));
  const Vector3d down = -weight_N_ * (rest.pose.linear().transpose() * world_.hand().up);
  const grasp::GraspForces forces =
      grasp::ComputeGraspForces(plan::ContactsOf(grasp), solid_.wrench_frame(),
                                options_.friction_angle, {down, Vector3d::Zero()}, grasp_force);
  return forces.balanced ? std::optional(grasp_force) : std::nullopt;
}

std::variant<ResetState, Reason> ResetStates::Make(const plan::HandState& rest,
                                                   const plan::FingerGrasp& grasp,
                                                   double grasp_force_N) {
  monitor_.CopyState(fresh_);
  try {
    TakeHold(rest, grasp, grasp_force_N);
  } catch (const UnstableError&) {
    return Reason::kSimulationUnstable;
  }
  if (const auto failure = Failure()) return *failure;
  ResetState state = Store(grasp, grasp_force_N);
  if (const auto failure = Validate(state)) return *failure;
  return state;
}

void ResetStates::TakeHold(const plan::HandState& rest, const plan::FingerGrasp& grasp,
                           double grasp_force_N) {
  world_.Place(rest);
  // The measured pose is not used, since the stored state is the final one, at any pose of the
  // object.
  HandControl control(world_, solid_, scale_,
                      {options_.friction_angle, weight_N_, {.feedback = PoseFeedback::kNone}});
  Hold hold = {{}, grasp_force_N};
  for (const plan::FingerContact& held : grasp) {
    control.Attach(held.finger);
    hold.fingers.push_back(held.finger);
  }
  // The object is fixed until the fingers hold it.
  world_.PinObject(true);
  const int taking = StepsIn(kTakeHold, world_);
  for (int i = 1; i <= taking; ++i) {
    control.SetHolding({hold, hold, 1, static_cast<double>(i) / taking});
    control.Step();
  }
  world_.PinObject(false);
  for (const FingerIndex f : hold.fingers) monitor_.SetHolding(f, true);
  for (int i = StepsIn(kSettle, world_); i > 0 && !Failure(); --i) {
    control.Step();
    monitor_.Watch(rest.pose);
  }
}

std::optional<Reason> ResetStates::Failure() const {
  if (!monitor_.violation()) return std::nullopt;
  return monitor_.violation()->reason;
}

ResetState ResetStates::Store(const plan::FingerGrasp& grasp, double grasp_force_N) const {
  ResetState state;
  state.joints = world_.joint_angles();
  state.controls = world_.controls();
  const Isometry3d pose = world_.object_pose();
  state.position = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  state.quaternion = {q.w(), q.x(), q.y(), q.z()};
  state.grasp_force_N = grasp_force_N;
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
  monitor_.CopyState(fresh_);
  for (FingerIndex f{0}; f < std::ssize(state.tips); ++f)
    monitor_.SetHolding(f, state.tips[f].holds);
  try {
    for (int i = StepsIn(kHeld, world_); i > 0 && !Failure(); --i) {
      world_.Step();
      monitor_.Watch(pose);
    }
  } catch (const UnstableError&) {
    return Reason::kSimulationUnstable;
  }
  state.off_m = monitor_.measures().off_m;
  state.off_rad = monitor_.measures().off_rad;
  return Failure();
}

namespace {

using Values = std::vector<double>;

void AppendVector(const Eigen::VectorXd& vector, Values& values) {
  values.insert(values.end(), vector.begin(), vector.end());
}

/// Return an array with a row per state.
/// @param shape   shape of a row.
/// @param append  function that appends a state's row to values.
template <typename AppendRow>
NpzArray RowsOf(const DrawnStates& drawn, const std::string& name, std::vector<std::size_t> shape,
                const AppendRow& append) {
  shape.insert(shape.begin(), drawn.states.size());
  NpzArray array{name, std::move(shape)};
  for (const ResetState& state : drawn.states) append(state, array.values);
  return array;
}

/// Return an array with a row per state and finger.
template <typename AppendTip>
NpzArray TipsOf(const DrawnStates& drawn, const std::string& name, std::vector<std::size_t> shape,
                const AppendTip& append) {
  return RowsOf(drawn, name, std::move(shape), [&](const ResetState& state, Values& values) {
    for (const ResetState::Tip& tip : state.tips) append(tip, values);
  });
}

/// Return an array of vectors of holding fingers; NaN for other fingers.
NpzArray VectorsOf(const DrawnStates& drawn, const std::string& name, std::size_t fingers,
                   Eigen::Vector3d ResetState::Tip::*vector) {
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return TipsOf(drawn, name, {fingers, 3}, [&](const ResetState::Tip& tip, Values& values) {
    AppendVector(tip.holds ? tip.*vector : none, values);
  });
}

NpzArray ListsOf(const DrawnStates& drawn, const std::string& name,
                 std::vector<double> ResetState::*list) {
  const std::size_t length = drawn.states.empty() ? 0 : (drawn.states.front().*list).size();
  return RowsOf(drawn, name, {length}, [list](const ResetState& state, Values& values) {
    values.insert(values.end(), (state.*list).begin(), (state.*list).end());
  });
}

NpzArray ResetNumbersOf(const DrawnStates& drawn, const std::string& name,
                        double ResetState::*number) {
  return RowsOf(drawn, name, {}, [number](const ResetState& state, Values& values) {
    values.push_back(state.*number);
  });
}

/// Version of the file format: 2 calls the mask of fingers in contact `active` instead of `holds`.
constexpr double kStatesVersion = 2;

NpzArray Names(const std::string& name, const std::vector<std::string>& texts) {
  return {name, {texts.size()}, {}, texts};
}
NpzArray Number(const std::string& name, double value) { return {name, {}, {value}}; }
NpzArray Text(const std::string& name, const std::string& text) { return {name, {}, {}, {text}}; }

void AddStates(const DrawnStates& drawn, std::size_t fingers, std::vector<NpzArray>& arrays) {
  arrays.push_back(ListsOf(drawn, "joints", &ResetState::joints));
  arrays.push_back(ListsOf(drawn, "controls", &ResetState::controls));
  arrays.push_back(ListsOf(drawn, "qpos", &ResetState::qpos));
  arrays.push_back(RowsOf(
      drawn, "object_position", {3},
      [](const ResetState& state, Values& values) { AppendVector(state.position, values); }));
  arrays.push_back(RowsOf(
      drawn, "object_quaternion", {4},
      [](const ResetState& state, Values& values) { AppendVector(state.quaternion, values); }));
  arrays.push_back(
      TipsOf(drawn, "active", {fingers},
             [](const ResetState::Tip& tip, Values& values) { values.push_back(tip.holds); }));
  arrays.back().is_truth = true;
  arrays.push_back(VectorsOf(drawn, "contact_points", fingers, &ResetState::Tip::contact_O));
  arrays.push_back(VectorsOf(drawn, "contact_forces", fingers, &ResetState::Tip::force_O));
  arrays.push_back(ResetNumbersOf(drawn, "squeeze_N", &ResetState::grasp_force_N));
  arrays.push_back(ResetNumbersOf(drawn, "off_m", &ResetState::off_m));
  arrays.push_back(ResetNumbersOf(drawn, "off_rad", &ResetState::off_rad));
}

void AddSettings(const kinematics::HandModel& hand, const ResetStateOptions& options,
                 const ResetStatesOrigin& origin, std::vector<NpzArray>& arrays) {
  NpzArray gravity{"gravity", {3}};
  AppendVector(-kGravity * hand.up, gravity.values);
  arrays.push_back(std::move(gravity));
  arrays.push_back(Number("mu", std::tan(options.friction_angle)));
  arrays.push_back(Number("mass_kg", options.mass_kg));
  arrays.push_back(Number("scale", origin.scale));
  arrays.push_back(Number("held_s", ResetStates::kHeld));
  const HandTolerance& tolerance = options.tolerance;
  arrays.push_back(Number("tolerance_m", tolerance.at_rest * tolerance.length_m));
  arrays.push_back(Number("tolerance_rad", tolerance.at_rest * tolerance.angle_rad));
  arrays.push_back(Text("seed", std::to_string(origin.seed)));  // 64 bits
  arrays.push_back(Text("object", origin.object));
  arrays.push_back(Text("object_sha256", origin.object_sha256));
  arrays.push_back(Text("hand", hand.file));
  arrays.push_back(Text("hand_sha256", hand.sha256));
}

void AddFallen(const DrawnStates& drawn, std::vector<NpzArray>& arrays) {
  std::vector<std::string> reasons;
  Values fallen;
  for (const plan::Reason reason :
       {plan::Reason::kContactLost, plan::Reason::kSlipped, plan::Reason::kObjectMoved,
        plan::Reason::kHandCollides, plan::Reason::kTorqueLimit, plan::Reason::kSimulationUnstable,
        plan::Reason::kJointLimit, plan::Reason::kCouplingViolated, plan::Reason::kTipPenetrates}) {
    const auto found = drawn.fallen.find(reason);
    reasons.emplace_back(plan::ReasonName(reason));
    fallen.push_back(found == drawn.fallen.end() ? 0 : static_cast<double>(found->second));
  }
  arrays.push_back(Names("fallen_reasons", reasons));
  arrays.push_back({"fallen", {fallen.size()}, fallen});
  arrays.push_back(Number("unbalanced", static_cast<double>(drawn.unbalanced)));
}

}  // namespace

std::string FormatResetStates(const DrawnStates& drawn, const kinematics::HandModel& hand,
                              const ResetStateOptions& options, const ResetStatesOrigin& origin) {
  std::vector<std::string> fingers;
  for (const kinematics::Finger& finger : hand.fingers) fingers.push_back(finger.name);
  std::vector<NpzArray> arrays = {Number("format_version", kStatesVersion)};
  AddStates(drawn, fingers.size(), arrays);
  arrays.push_back(Names("joint_names", drawn.joint_names));
  arrays.push_back(Names("control_names", drawn.control_names));
  arrays.push_back(Names("finger_names", fingers));
  arrays.push_back(Number("timestep_s", drawn.timestep_s));
  AddSettings(hand, options, origin, arrays);
  AddFallen(drawn, arrays);
  return FormatNpz(arrays);
}

namespace {

/// Data of one thread.
struct Worker {
  ResetStates states;
  DrawRest draw;
};

/// Pool that gives each thread its own worker.
class Workers {
 public:
  void Put(std::unique_ptr<Worker> worker) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(worker));
  }
  std::unique_ptr<Worker> Take() {
    const std::scoped_lock lock(mutex_);
    auto worker = std::move(idle_.back());
    idle_.pop_back();
    return worker;
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> idle_;
};

/// A state, and the grasps that were drawn for it before.
struct Found {
  ResetState state;
  std::map<plan::Reason, std::int64_t> fallen;
  std::int64_t unbalanced = 0;
};

/// Exception that ends the draw, since no state was found.
struct NoState {
  std::string message;
};

std::string CountText(const Found& tried) {
  std::string text =
      std::to_string(tried.unbalanced) + " without feasible contact forces that support the weight";
  for (const auto& [reason, count] : tried.fallen) {
    text += ", " + std::to_string(count) + " " + std::string(plan::ReasonName(reason));
  }
  return text;
}

Found FindState(RandomStream random, int most_simulated, Worker& worker) {
  Found found;
  for (int i = 0; i < most_simulated; ++i) {
    const auto rest = worker.draw(random);
    if (!rest) throw NoState{"random grasps within reach of the hand are not force closure"};
    const auto grasp_force = worker.states.GraspForceOf(rest->state, rest->grasp);
    if (!grasp_force) {
      ++found.unbalanced;
      continue;
    }
    auto made = worker.states.Make(rest->state, rest->grasp, *grasp_force);
    if (auto* state = std::get_if<ResetState>(&made)) {
      found.state = std::move(*state);
      return found;
    }
    ++found.fallen[std::get<plan::Reason>(made)];
  }
  throw NoState{"none of " + std::to_string(most_simulated) +
                " random grasps within reach of the hand holds the object: " + CountText(found)};
}

DrawnStates Collect(std::vector<Found> found, const HandWorld& world) {
  DrawnStates drawn;
  drawn.joint_names = world.joint_names();
  drawn.control_names = world.control_names();
  drawn.timestep_s = world.timestep();
  for (Found& one : found) {
    drawn.states.push_back(std::move(one.state));
    drawn.unbalanced += one.unbalanced;
    for (const auto& [reason, count] : one.fallen) drawn.fallen[reason] += count;
  }
  return drawn;
}

}  // namespace

std::int64_t DrawnStates::fallen_count() const {
  std::int64_t count = 0;
  for (const auto& [reason, times] : fallen) count += times;
  return count;
}

double DrawnStates::fallen_share() const {
  const auto fell = static_cast<double>(fallen_count());
  return fell / std::max(1.0, fell + static_cast<double>(states.size()));
}

ShareInterval DrawnStates::interval() const {
  const auto fell = static_cast<int>(fallen_count());
  return ComputeShareInterval(fell, fell + static_cast<int>(states.size()), kTrialConfidence);
}

DrawnStates DrawResetStates(const kinematics::HandFile& file, const object::Polyhedron& solid,
                            double scale, const ResetStateOptions& states,
                            const DrawnStatesOptions& options,
                            const std::function<DrawRest()>& make_draw) {
  const EngineHooks hooks;  // shared by all threads; separate hooks are restored in no fixed order
  Workers workers;
  for (int i = 0; i < std::min(options.jobs, options.count); ++i) {
    workers.Put(std::unique_ptr<Worker>(new Worker{{file, solid, scale, states}, make_draw()}));
  }
  std::vector<Found> found(options.count);
  std::mutex telling;
  int done = 0;
  try {
    InBlocks(found.size(), 1, options.jobs, [&](std::size_t begin, std::size_t /*end*/) {
      auto worker = workers.Take();
      found[begin] = FindState(RandomStream(options.seed, RandomUse::kResetStates, begin),
                               options.most_simulated, *worker);
      workers.Put(std::move(worker));
      const std::scoped_lock lock(telling);
      ++done;
      if (options.told) options.told(done);
    });
  } catch (const NoState& none) {
    DrawnStates nothing;
    nothing.message = none.message;
    return nothing;
  }
  return Collect(std::move(found), workers.Take()->states.world());
}

}  // namespace regrasp::sim
