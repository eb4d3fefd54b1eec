#include "sim/actuation/hand_replay.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/random.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/plan/plan.h"
#include "sim/actuation/entry_replay.h"
#include "sim/actuation/hand_sensors.h"
#include "sim/actuation/hand_world.h"
#include "sim/actuation/ode_hand.h"
#include "sim/actuation/torque_grasp_force.h"
#include "sim/scene/scaling.h"

namespace regrasp::sim {

namespace {

using Eigen::Vector3d;
using plan::HandState;

/// Largest number of static grasps that HandReplays stores, about 20 kB each.
constexpr int kMostKnown = 5000;

/// Height of the fingertips of the initial grasp above their contacts at the start, metres. It is
/// more than errors of joints and object amount to.
constexpr double kOpening = 2e-3;

/// Move the fingertips of a grasp away from the object along the normals.
void Open(const kinematics::HandModel& hand, const plan::FingerGrasp& grasp, HandState& state) {
  constexpr int kIterations = 10;
  constexpr double kDamping = 2e-3;  // metres
  for (const plan::FingerContact& held : grasp) {
    const kinematics::Finger& chain = hand.fingers[held.finger];
    kinematics::JointConfiguration configuration =
        ConfigurationOf(chain, state.joints[held.finger]);
    const Vector3d outward = -(state.pose.linear() * held.contact.n);
    const Vector3d wanted = kinematics::TipAt(chain, configuration).centre + kOpening * outward;
    for (int i = 0; i < kIterations; ++i) {
      const kinematics::TipState tip = kinematics::TipAt(chain, configuration);
      const Eigen::Matrix3d damped = tip.jacobian * tip.jacobian.transpose() +
                                     kDamping * kDamping * Eigen::Matrix3d::Identity();
      configuration += tip.jacobian.transpose() * damped.ldlt().solve(wanted - tip.centre);
      configuration = configuration.cwiseMax(chain.lower).cwiseMin(chain.upper);
    }
    state.joints[held.finger] = kinematics::JointAngles(chain, configuration);
  }
}

/// Return the initial state of hand and object.
HandState StartOf(const kinematics::HandModel& hand, const plan::Plan& plan,
                  const HandReplayOptions& options, const Vector3d& centroid) {
  HandState start = plan.hand->initial;
  Open(hand, plan.initial, start);
  const double angle = options.start_turn_rad.norm();
  if (angle > 0) {
    const Eigen::AngleAxisd turn(angle, options.start_turn_rad / angle);
    start.pose =
        start.pose * Eigen::Translation3d(centroid) * turn * Eigen::Translation3d(-centroid);
  }
  start.pose = start.pose * Eigen::Translation3d(options.start_shift_m);
  return start;
}

ReplaySettings SettingsOf(const HandEngine& world, const object::Polyhedron& solid,
                          const plan::Plan& plan, const std::vector<double>& grasp_forces,
                          const HandReplayOptions& options) {
  ReplaySettings s;
  s.mu = std::tan(plan.friction_angle);
  s.mass_kg = *options.mass_kg;
  s.grasp_force_N = *std::ranges::max_element(grasp_forces);
  s.grasp_force_source =
      options.grasp_force_N ? GraspForceSource::kGiven : GraspForceSource::kTorques;
  s.disturbance_ratio = options.disturbance_ratio;
  s.protocol = Protocol::kFixed;
  s.engine = options.engine;
  s.gravity_m_s2 = kGravity;
  s.diameter_m = plan.scale * solid.diameter();
  s.tolerance = options.tolerance.length_m / s.diameter_m;
  s.fingertip_radius_m = world.hand().fingers.front().tip.radius;
  s.timestep_s = world.timestep();
  s.friction_factor = options.friction_factor;
  s.mass_factor = options.mass_factor;
  HandReplaySettings& hand = s.hand.emplace();
  hand.tolerance = options.tolerance;
  hand.sensing = options.sensing;
  hand.physics = options.physics;
  hand.tip = options.tip;
  hand.limits = world.limits();
  hand.least_stiffness = std::numeric_limits<double>::infinity();
  for (FingerIndex f{0}; f < std::ssize(world.hand().fingers); ++f) {
    for (int drive = 0; drive < world.hand().fingers[f].drives; ++drive) {
      const DriveServo& servo = world.servo(f, drive);
      hand.least_stiffness = std::min(hand.least_stiffness, servo.stiffness);
      hand.largest_stiffness = std::max(hand.largest_stiffness, servo.stiffness);
      hand.derived_servos = hand.derived_servos || servo.derived;
      if (servo.model_stiffness == 0) continue;
      hand.soft_stiffness =
          std::min(servo.model_stiffness, hand.soft_stiffness.value_or(servo.model_stiffness));
    }
  }
  return s;
}

/// Return the options with the mass of the object.
HandReplayOptions WithMass(HandReplayOptions options, const object::Polyhedron& solid,
                           const plan::Plan& plan) {
  UseMassOf(plan, options);
  options.mass_kg = BodyOf(solid, plan.scale, options).mass_kg;
  return options;
}

/// Return the errors of the joint sensors, by finger.
std::vector<kinematics::JointConfiguration> JointErrors(const kinematics::HandModel& hand,
                                                        const HandSensing& sensing) {
  std::vector<kinematics::JointConfiguration> errors = sensing.joint_offsets;
  if (sensing.joint_bias_rad == 0) return errors;
  for (std::size_t f = 0; f < hand.fingers.size(); ++f) {
    const int drives = hand.fingers[f].drives;
    if (f >= errors.size()) errors.emplace_back(kinematics::JointConfiguration::Zero(drives));
    RandomStream random(sensing.seed, RandomUse::kJointErrors, f);
    for (double& error : errors[f]) error += sensing.joint_bias_rad * random.Normal();
  }
  return errors;
}

/// @pre the mass is set.
HandWorldOptions WorldOptions(const kinematics::HandModel& hand, const HandReplayOptions& options,
                              double friction_angle) {
  return {options.friction_factor * std::tan(friction_angle),
          options.mass_factor * *options.mass_kg,
          kGravity,
          options.force_factor,
          options.physics,
          JointErrors(hand, options.sensing),
          options.tip};
}

HandControlSettings ControlSettings(const plan::Plan& plan, const HandReplayOptions& options) {
  return {plan.friction_angle, *options.mass_kg * kGravity, options.sensing,
          plan.hand && plan.hand->gravity_support.has_value()};
}

/// Return the grasp force of each static grasp, newtons.
/// @param world  changes to an arbitrary state.
std::vector<double> GraspForcesOf(HandEngine& world, const object::Polyhedron& solid,
                                  const plan::Plan& plan, const HandReplayOptions& options,
                                  int entries) {
  if (options.grasp_force_N) return std::vector<double>(entries, *options.grasp_force_N);
  return ComputeGraspForcesOfPlan(world, solid, plan, entries, plan.friction_angle,
                                  *options.mass_kg * kGravity);
}

void Append(const HandState& state, std::vector<double>& numbers) {
  const Eigen::Matrix4d& pose = state.pose.matrix();
  numbers.insert(numbers.end(), pose.data(), pose.data() + pose.size());
  for (const auto& joints : state.joints) {
    numbers.insert(numbers.end(), joints.begin(), joints.end());
  }
}

void Append(const plan::FingerGrasp& grasp, std::vector<double>& numbers) {
  numbers.push_back(static_cast<double>(grasp.size()));
  for (const plan::FingerContact& held : grasp) {
    numbers.push_back(held.finger);
    for (const Vector3d& v : {held.contact.p, held.contact.n}) {
      numbers.insert(numbers.end(), v.data(), v.data() + 3);
    }
  }
}

/// Return all inputs of a replay from an entry of a plan. Equal numbers give equal replays.
std::vector<double> NumbersOf(const plan::Plan& plan, plan::EntryIndex entry) {
  std::vector<double> numbers;
  if (entry == 0) {
    numbers.push_back(plan.scale);
    Append(plan.hand->initial, numbers);
    Append(plan.initial, numbers);
    return numbers;
  }
  const plan::Step& step = plan::StepOf(plan, entry);
  numbers.push_back(static_cast<double>(step.index()));
  if (const auto* change = std::get_if<plan::Switch>(&step)) {
    Append(change->place, numbers);
    for (const FingerIndex f : change->release) numbers.push_back(f);
  } else if (const auto* align = std::get_if<plan::Align>(&step)) {
    for (const plan::FingerGrasp& grasp : align->waypoints) Append(grasp, numbers);
  }
  for (const plan::HandPath* path : plan::PathsOf(step)) {
    numbers.push_back(static_cast<double>(path->size()));
    for (const HandState& state : *path) Append(state, numbers);
  }
  return numbers;
}

std::unique_ptr<HandEngine> MakeEngine(const kinematics::HandFile& file,
                                       const object::Polyhedron& solid, double scale,
                                       const HandReplayOptions& options, double friction_angle) {
  const HandWorldOptions world = WorldOptions(file.hand, options, friction_angle);
  if (options.engine == EngineChoice::kOde) {
    return std::make_unique<OdeHand>(file, solid, scale, world);
  }
  return std::make_unique<HandWorld>(file, solid, scale, world);
}

/// Return the observer of a replay's steps. Observers of states know MuJoCo's world only.
EntryObserver ObserverOf(const HandEngine& engine, const ReplayObserver& observer) {
  EntryObserver made;
  const auto* world = dynamic_cast<const HandWorld*>(&engine);
  if (world == nullptr) return made;
  if (observer.on_time_step)
    made.on_time_step = [world, &observer] { observer.on_time_step(*world); };
  if (observer.on_rest) {
    made.on_rest = [world, &observer](plan::EntryIndex entry) { observer.on_rest(*world, entry); };
  }
  return made;
}

/// Replay a plan in one engine.
ReplayResult ReplayOnce(const kinematics::HandFile& file, const object::Polyhedron& solid,
                        const plan::Plan& plan, const HandReplayOptions& given,
                        const ReplayObserver& observer, int entries) {
  const HandReplayOptions options = WithMass(given, solid, plan);
  const std::unique_ptr<HandEngine> engine =
      MakeEngine(file, solid, plan.scale, options, plan.friction_angle);
  HandEngine& world = *engine;
  const std::vector<double> grasp_forces = GraspForcesOf(world, solid, plan, options, entries);
  ReplayResult result;
  result.settings = SettingsOf(world, solid, plan, grasp_forces, options);
  world.Place(StartOf(world.hand(), plan, options, world.centroid_O()));
  EntryReplay replay(world, solid, plan, ControlSettings(plan, options), grasp_forces, options,
                     ObserverOf(world, observer));
  for (plan::EntryIndex index{0}; index < entries; ++index) {
    result.steps.push_back(replay.Carry(index));
    if (observer.on_progress) observer.on_progress(int{index} + 1, entries);
    const bool fails = result.steps.back().reason != plan::Reason::kNone;
    if (fails && (!options.to_end || replay.has_ended())) break;
  }
  return result;
}

HandReplayOptions In(EngineChoice engine, HandReplayOptions options) {
  options.engine = engine;
  return options;
}

}  // namespace

namespace {

/// @throws std::invalid_argument  if gravity acts on a plan in another direction than on the hand.
void CheckGravity(const kinematics::HandModel& hand, const plan::Plan& plan) {
  if (!plan.hand || !plan.hand->up || plan.hand->up->isApprox(hand.up)) return;
  throw std::invalid_argument("ReplayHand: gravity acts in another direction than on the plan");
}

/// Check that a hand can replay a plan.
/// @throws InputError  if the plan is for soft-finger contacts.
/// @throws std::invalid_argument  as CheckGravity.
void CheckReplayable(const kinematics::HandModel& hand, const plan::Plan& plan) {
  CheckGravity(hand, plan);
  if (plan.torsion == 0) return;
  throw InputError(
      "hand replay: soft-finger contacts not supported, expected hard contacts; help: --replay "
      "points");
}

}  // namespace

ReplayResult ReplayHand(const kinematics::HandFile& file, const object::Polyhedron& solid,
                        const plan::Plan& plan, const HandReplayOptions& given,
                        const ReplayObserver& observer, int steps) {
  CheckReplayable(file.hand, plan);
  const int entries = steps < 0 ? static_cast<int>(plan.steps.size()) + 1 : steps;
  if (given.engine != EngineChoice::kBoth) {
    return ReplayOnce(file, solid, plan, given, observer, entries);
  }
  ReplayResult result =
      ReplayOnce(file, solid, plan, In(EngineChoice::kMujoco, given), observer, entries);
  const int replayed = static_cast<int>(result.steps.size());
  ReplayResult second = ReplayOnce(file, solid, plan, In(EngineChoice::kOde, given), {}, replayed);
  for (StepReplay& step : second.steps) {
    result.steps[step.index].ode = static_cast<StepMotion&>(step);
    result.steps[step.index].ode_hand = std::move(step.hand);
  }
  result.settings.engine = EngineChoice::kBoth;
  return result;
}

std::optional<planning::GraspForceNeed> MeasureGraspForce(const kinematics::HandFile& file,
                                                          const object::Polyhedron& solid,
                                                          const plan::Plan& plan,
                                                          const HandReplayOptions& given,
                                                          int steps) {
  CheckGravity(file.hand, plan);
  const HandReplayOptions options = WithMass(given, solid, plan);
  const std::unique_ptr<HandEngine> world =
      MakeEngine(file, solid, plan.scale, options, plan.friction_angle);
  const plan::EntryIndex entry(std::min(steps, static_cast<int>(plan.steps.size())));
  return ComputeGraspForceNeed(*world, solid, plan, entry, plan.friction_angle,
                               *options.mass_kg * kGravity);
}

struct HandReplays::Impl {
  /// A static grasp that a plan reached, and its successors.
  struct Come {
    StepReplay step;
    EntryReplay::Rested rested;
    std::map<std::vector<double>, std::unique_ptr<Come>> next = {};  ///< successors by NumbersOf
  };
  using Next = std::map<std::vector<double>, std::unique_ptr<Come>>;

  kinematics::HandFile file;
  const object::Polyhedron& solid;
  HandReplayOptions given;
  HandReplayOptions options = {};  ///< options with the mass of the object
  double friction_angle = 0;
  double scale = 0;
  bool has_gravity_support = false;
  std::unique_ptr<HandEngine> world = {};
  Next begun = {};  ///< initial grasps
  int known = 0;    ///< total number of stored static grasps

  void Forget() {
    begun.clear();
    known = 0;
  }

  void MakeWorldFor(const plan::Plan& plan) {
    HandReplayOptions wanted = WithMass(given, solid, plan);
    const bool has_support = plan.hand->gravity_support.has_value();
    if (has_support != has_gravity_support) Forget();
    has_gravity_support = has_support;
    if (world && friction_angle == plan.friction_angle && scale == plan.scale &&
        options.mass_kg == wanted.mass_kg) {
      return;
    }
    friction_angle = plan.friction_angle;
    scale = plan.scale;
    Forget();
    options = std::move(wanted);
    world = MakeEngine(file, solid, scale, options, friction_angle);
  }

  ReplayResult Run(const plan::Plan& plan, const Deadline& deadline) {
    MakeWorldFor(plan);
    if (known > kMostKnown) Forget();
    const int entries = static_cast<int>(plan.steps.size()) + 1;
    world->PinObject(false);
    const std::vector<double> grasp_forces = GraspForcesOf(*world, solid, plan, options, entries);
    ReplayResult result;
    result.settings = SettingsOf(*world, solid, plan, grasp_forces, options);
    world->Place(StartOf(world->hand(), plan, options, world->centroid_O()));
    EntryReplay replay(*world, solid, plan, ControlSettings(plan, options), grasp_forces, options,
                       {});
    Next* next = &begun;
    const Come* last = nullptr;
    plan::EntryIndex index{0};
    for (; index < entries; ++index) {
      const auto found = next->find(NumbersOf(plan, index));
      if (found == next->end()) break;
      last = found->second.get();
      result.steps.push_back(last->step);
      next = &found->second->next;
    }
    if (last != nullptr) replay.GoOnFrom(last->rested);
    for (; index < entries && !deadline.IsOver(); ++index) {
      result.steps.push_back(replay.Carry(index));
      if (result.steps.back().reason != plan::Reason::kNone) break;
      auto& come = (*next)[NumbersOf(plan, index)];
      come = std::make_unique<Come>(Come{result.steps.back(), replay.rested()});
      next = &come->next;
      ++known;
    }
    return result;
  }
};

HandReplays::HandReplays(kinematics::HandFile file, const object::Polyhedron& solid,
                         const HandReplayOptions& options)
    : impl_(new Impl{std::move(file), solid, options}) {}
HandReplays::~HandReplays() = default;

ReplayResult HandReplays::Replay(const plan::Plan& plan, const Deadline& deadline) {
  CheckReplayable(impl_->file.hand, plan);
  return impl_->Run(plan, deadline);
}

namespace {

/// Return the seed of the sensors in a trial, different for each trial.
std::uint64_t SensingSeed(std::uint64_t nominal, std::uint64_t seed, int trial) {
  constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15;  // odd, with well-mixed bits
  return (nominal + kFactor * (seed + 1)) * kFactor + static_cast<std::uint64_t>(trial);
}

}  // namespace

TrialSummary RunHandTrials(const kinematics::HandFile& file, const object::Polyhedron& solid,
                           const plan::Plan& plan, const HandReplayOptions& options,
                           const TrialOptions& trials,
                           const std::function<void(int done)>& progress) {
  const double radius = plan.scale * solid.diameter() / 2;
  const double deviation = trials.position_noise * 2 * radius;
  const auto replay = [&](int trial) {
    RandomStream random(trials.seed, RandomUse::kTrialContacts, trial);
    const TrialFactors factors = DrawTrialFactors(trials, trial);
    HandReplayOptions drawn = options;
    // With two engines MuJoCo decides.
    if (options.engine == EngineChoice::kBoth) drawn.engine = EngineChoice::kMujoco;
    drawn.friction_factor = factors.friction;
    drawn.mass_factor = factors.mass;
    drawn.start_shift_m = DrawNormalVector(deviation, random);
    drawn.start_turn_rad = DrawNormalVector(deviation / radius, random);
    for (const kinematics::Finger& finger : file.hand.fingers) {
      kinematics::JointConfiguration& offsets =
          drawn.sensing.joint_offsets.emplace_back(finger.drives);
      for (double& offset : offsets) offset = trials.joint_noise.value_or(0) * random.Normal();
    }
    drawn.sensing.seed = SensingSeed(options.sensing.seed, trials.seed, trial);
    return ReplayHand(file, solid, plan, drawn).steps.back();
  };
  return CountTrials(trials, replay, progress);
}

}  // namespace regrasp::sim
