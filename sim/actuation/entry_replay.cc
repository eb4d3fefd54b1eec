#include "sim/actuation/entry_replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/plan/plan.h"
#include "sim/actuation/execution_monitor.h"
#include "sim/actuation/hand_control.h"
#include "sim/actuation/sliding_tips.h"
#include "sim/actuation/torque_grasp_force.h"
#include "sim/measure/disturbance.h"
#include "sim/scene/engine.h"
#include "sim/scene/scaling.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::HandState;

// Durations, seconds.
constexpr double kTakeHold = 0.3;
constexpr double kHandover = 0.25;
constexpr double kSettle = 0.3;
constexpr double kHandDisturbanceRamp = 0.05;
constexpr double kDisturbanceHold = 0.1;
// A finger approaches along the normal from this height (metres) until it touches.
constexpr double kHeight = 8e-3;
constexpr double kDescent = 0.02;     // m/s
constexpr double kTouchdown = 0.01;   // m/s, below kSlowHeight: commands come late
constexpr double kSlowHeight = 2e-3;  // metres
constexpr double kDeepest = 4e-3;     // largest depth below the planned place
/// Smallest margin, a share of the grasp force, at which the other fingers balance sliding fingers.
constexpr double kHeldBySome = -1e-3;
/// Distance from the object, metres, at which a released finger returns to its planned joints.
constexpr double kClear = 2e-3;
constexpr double kSlowest = 0.05;  ///< rad/s

/// Largest lag of servos behind their targets while fingers hold the object, radians.
constexpr double kMostLag = 0.025;

/// Return the joint speed at which no servo exceeds kMostLag. A servo of damping c and stiffness k
/// lags by c / k times the speed.
double CarryingSpeed(const HandEngine& world) {
  double speed = kHeldJoints;
  for (FingerIndex f{0}; f < std::ssize(world.hand().fingers); ++f) {
    for (int drive = 0; drive < world.hand().fingers[f].drives; ++drive) {
      const DriveServo& servo = world.servo(f, drive);
      const double damping = servo.damping + servo.joint_damping;
      speed = std::min(speed, kMostLag * servo.stiffness / std::max(damping, 1e-9));
    }
  }
  return std::max(speed, kSlowest);
}

// The frozen hand and object count as still, and remain so, if no velocity (m/s, rad/s) exceeds
// kFrozenStill for kFrozenStillTime (seconds) and the last one is smaller than the first.
constexpr double kFrozenStill = 1e-5;
constexpr double kFrozenStillTime = 0.1;
/// Motion of an object that has certainly fallen, metres.
constexpr double kFallen = 0.05;
/// Distance of the object from its planned pose beyond which no further step is executed, metres.
constexpr double kLost = 0.02;

/// Exception that ends a failed step.
struct StepFails {};

}  // namespace

/// A finger that approaches a contact, in the object's frame.
struct EntryReplay::Coming {
  FingerIndex finger;
  Vector3d touching;  ///< target of the fingertip sphere's centre
  Vector3d outward;
  double height = 0;                  ///< initial height above the contact
  Vector3d aside = Vector3d::Zero();  ///< initial lateral offset
  bool down = false;
};

EntryReplay::EntryReplay(HandEngine& world, const object::Polyhedron& solid, const plan::Plan& plan,
                         const HandControlSettings& control, std::vector<double> grasp_forces,
                         const HandReplayOptions& options, EntryObserver observer)
    : world_(world),
      plan_(plan),
      grasp_forces_(std::move(grasp_forces)),
      disturbance_ratio_(options.disturbance_ratio),
      freeze_s_(options.freeze_s),
      radius_(plan.scale * solid.diameter() / 2),
      start_off_(options.start_shift_m.norm() + radius_ * options.start_turn_rad.norm()),
      observer_(std::move(observer)),
      monitor_(world, solid, plan.scale, options.tolerance),
      control_(world, solid, plan.scale, control),
      state_(plan.hand->initial),
      to_end_(options.to_end) {
  // The fingers start off the plan. That is not a motion of the plan.
  control_.Steer(state_);
}

void EntryReplay::GoOnFrom(const Rested& rest) {
  rest_ = rest.world;
  world_.Restore(rest_);
  control_.CopyState(rest.control);
  monitor_.CopyState(rest.monitor);
  state_ = rest.state;
  holding_ = rest.holding;
}

StepReplay EntryReplay::Carry(plan::EntryIndex index) {
  StepReplay step;
  step.index = index;
  monitor_.Start();
  try {
    Perform(index);
    Rest();
    monitor_.SetComplete();
    step.snapshot = SnapshotNow();
    if (observer_.on_rest) observer_.on_rest(index);
    rest_ = world_.Save();
    // The rest of the replay then depends on this state alone. It is saved only once, because the
    // engine normalizes quaternions whenever it is restored.
    world_.Restore(rest_);
    Freeze();
    ApplyDisturbances();
  } catch (const StepFails&) {
    has_ended_ = true;
    step.snapshot = SnapshotNow();
  } catch (const UnstableError& error) {
    has_ended_ = true;
    // With to_end, a violated limit can precede the divergence and is the reason then.
    if (!monitor_.violation()) {
      step.reason = plan::Reason::kSimulationUnstable;
      step.detail = std::string("the simulation diverges: ") + error.what();
    }
  }
  Describe(step);
  step.fixed = static_cast<const StepMotion&>(step);  // only servos resist the disturbance test
  return step;
}

void EntryReplay::Perform(plan::EntryIndex index) {
  grasp_force_ = grasp_forces_[index];
  grasp_force_before_ = index == 0 ? 0 : grasp_forces_[index - 1];
  if (index == 0) {
    TakeHold();
    return;
  }
  const plan::Step& step = plan::StepOf(plan_, index);
  if (const auto* move = std::get_if<plan::Move>(&step)) Move(move->path);
  if (const auto* change = std::get_if<plan::Switch>(&step)) Switch(*change);
  if (const auto* align = std::get_if<plan::Align>(&step)) Align(*align);
}

void EntryReplay::Describe(StepReplay& step) const {
  const HandMeasures& measures = monitor_.measures();
  step.hand = measures;
  step.hand->grasp_force_N = grasp_force_;
  step.displacement_m = measures.off_m;
  step.rotation_deg = Degrees(measures.off_rad);
  step.moved_m = measures.off_m + radius_ * measures.off_rad;
  step.drift_m = measures.rest_off_m + radius_ * measures.rest_off_rad;
  step.slip_m = measures.slip_m;
  step.hand->contact_off_m = ContactDeviation(step);
  const auto& violation = monitor_.violation();
  if (!violation || step.reason != plan::Reason::kNone) return;
  static_cast<Violation&>(step) = *violation;
  step.contact_lost = violation->reason == plan::Reason::kContactLost;
}

double EntryReplay::ContactDeviation(const StepReplay& step) const {
  plan::FingerGrasp planned = plan_.initial;
  for (plan::EntryIndex k{1}; k <= step.index; ++k) {
    planned = plan::GraspAfter(planned, plan::StepOf(plan_, k));
  }
  double off = 0;
  for (const plan::FingerState& finger : step.snapshot.fingers) {
    const plan::FingerContact* held = plan::FindFinger(planned, finger.finger);
    if (held == nullptr) continue;
    off = std::max(off, (finger.contact_W - plan_.scale * held->contact.p).norm());
  }
  return off;
}

plan::Snapshot EntryReplay::SnapshotNow() const {
  plan::Snapshot snapshot;
  snapshot.time_s = world_.time();
  const Isometry3d to_object = world_.object_pose().inverse();
  for (const FingerIndex f : holding_) {
    const TipTouch touch = world_.touch(f);
    plan::FingerState& finger = snapshot.fingers.emplace_back();
    finger.finger = f;
    finger.role = plan::FingerRole::kHolding;
    finger.tip_W = to_object * world_.tip(f);
    finger.contact_W = touch.point_O;
    finger.normal_W = touch.inward_O;
    finger.force_W = to_object.linear() * touch.force;
    snapshot.fingertip_radius_m = world_.hand().fingers[f].tip.radius;
  }
  return snapshot;
}

void EntryReplay::Tick() {
  control_.Steer(state_);
  control_.Step();
  monitor_.Watch(state_.pose);
  EndIfFailed();
}

void EntryReplay::EndIfFailed() const {
  if (!monitor_.violation()) return;
  const Vector3d& centre = world_.centroid_O();
  const double off = (world_.object_pose() * centre - state_.pose * centre).norm();
  if (!to_end_ || off > kLost) throw StepFails();
}

template <typename OnTick>
void EntryReplay::Run(double seconds, const OnTick& on_tick) {
  const int steps = std::max(1, static_cast<int>(std::lround(seconds / world_.timestep())));
  for (int i = 1; i <= steps; ++i) {
    on_tick(static_cast<double>(i) / steps);
    Tick();
    if (observer_.on_time_step && !disturbing_) observer_.on_time_step();
  }
}

void EntryReplay::TakeHold() {
  monitor_.SetPhase("while the hand grasps");
  // The object is fixed until the fingers hold it.
  world_.PinObject(true);
  monitor_.SetSettling(true);
  control_.SetFeedback(false);
  std::vector<Coming> coming = ComingTo(plan_.initial);
  Descend(state_, coming);
  for (const plan::FingerContact& held : plan_.initial) holding_.push_back(held.finger);
  monitor_.WatchContacts(plan_.initial, plan_.scale, start_off_);
  EndIfFailed();
  const Hold all = HeldWith(grasp_force_);
  Run(kTakeHold, [&](double share) { control_.SetHolding({all, all, 1, share}); });
  world_.PinObject(false);
  control_.SetFeedback(true);
  for (const FingerIndex f : holding_) monitor_.SetHolding(f, true);
}

void EntryReplay::Move(const plan::HandPath& path) {
  monitor_.SetPhase("during the in-hand motion");
  const TimedPath timed(path, CarryingSpeed(world_));
  const double duration = timed.duration();
  Run(duration, [&](double share) {
    state_ = timed.At(share * duration);
    control_.SetHolding({HeldWith(grasp_force_before_), HeldWith(grasp_force_), share, 1});
  });
}

void EntryReplay::Switch(const plan::Switch& change) {
  std::vector<FingerIndex> after = holding_;
  for (const plan::FingerContact& placed : change.place) after.push_back(placed.finger);
  std::erase_if(after, [&](FingerIndex f) {
    return std::ranges::find(change.release, f) != change.release.end();
  });
  if (!change.place.empty()) PlaceFingers(change);
  monitor_.SetPhase("while forces are handed over");
  for (const FingerIndex f : change.release) monitor_.SetHolding(f, false);
  HandOver(HeldWith(grasp_force_before_), {after, grasp_force_});
  for (const FingerIndex f : after) {
    if (std::ranges::find(holding_, f) == holding_.end()) monitor_.SetHolding(f, true);
  }
  holding_ = after;
  if (!change.release.empty()) ReleaseFingers(change);
}

void EntryReplay::HandOver(const Hold& from, const Hold& to) {
  Run(kHandover, [&](double share) { control_.SetHolding({from, to, share, 1}); });
  control_.SetHolding({to, to, 1, 1});
}

void EntryReplay::Align(const plan::Align& align) {
  Hold hold = HeldWith(grasp_force_before_);
  for (std::size_t i = 0; i + 1 < align.waypoints.size(); ++i) {
    Slide(align.waypoints[i], align.waypoints[i + 1], (*align.motion)[i], hold);
  }
  monitor_.SetPhase("while forces are handed over");
  ChangeSliding(align.waypoints.back(), hold, HeldWith(grasp_force_));
}

void EntryReplay::ChangeSliding(const plan::FingerGrasp& at, Hold& hold, const Hold& to) {
  for (const SlidingFinger& one : hold.sliding) {
    if (std::ranges::find(to.sliding, one.finger, &SlidingFinger::finger) != to.sliding.end()) {
      continue;
    }
    monitor_.WatchContacts({*plan::FindFinger(at, one.finger)}, plan_.scale);
    control_.Attach(one.finger);
    monitor_.SetHolding(one.finger, true);
  }
  HandOver(hold, to);
  hold = to;
}

void EntryReplay::Slide(const plan::FingerGrasp& from, const plan::FingerGrasp& to,
                        const plan::HandPath& path, Hold& hold) {
  const TimedPath timed(path, CarryingSpeed(world_));
  const SlidingTips tips(control_, world_.hand(), timed, from, to);
  if (tips.empty()) return;
  const Hold sliding = {holding_, hold.grasp_force_N, tips.At(0)};
  const bool is_held = control_.SlidingMargin(sliding, to) > kHeldBySome;
  const std::string unheld = "while a finger slides whose force the others cannot balance";
  const auto lead = [&](double share) {
    state_ = tips.StateAt(share);
    for (const SlidingFinger& tip : tips.At(share)) {
      const Vector3d centre_O = tips.CentreAt(tip.finger, share);
      control_.LeadAlongSurface(tip.finger, centre_O);
      monitor_.SetSliding(tip.finger, centre_O);
    }
  };
  monitor_.SetPhase(is_held ? "while forces are handed over" : unheld);
  lead(0);
  ChangeSliding(from, hold, sliding);
  monitor_.SetPhase(is_held ? "while a finger slides" : unheld);
  Run(tips.duration(), [&](double share) {
    lead(share);
    hold.sliding = tips.At(share);
    control_.SetHolding({hold, hold, 1, 1});
  });
}

std::vector<EntryReplay::Coming> EntryReplay::ComingTo(const plan::FingerGrasp& grasp) const {
  std::vector<Coming> coming;
  for (const plan::FingerContact& placed : grasp) {
    const double radius = world_.hand().fingers[placed.finger].tip.radius;
    const Vector3d outward = -placed.contact.n;
    coming.push_back({placed.finger, plan_.scale * placed.contact.p + radius * outward, outward});
  }
  return coming;
}

void EntryReplay::PlaceFingers(const plan::Switch& change) {
  monitor_.SetPhase("while a finger makes contact");
  const plan::HandPath& path = change.motion->place;
  std::vector<Coming> coming = ComingTo(change.place);
  const TimedPath timed(path, kFreeJoints);
  const double duration = timed.duration();
  const double begin = world_.time();
  // The fingers follow the path until the first of them is within kHeight of its contact.
  bool above = false;
  while (!above && world_.time() - begin < duration) {
    Run(world_.timestep(), [&](double) { state_ = timed.At(world_.time() - begin); });
    above = std::ranges::any_of(coming, [this](const Coming& finger) {
      return (PlannedTip(world_.hand(), state_, finger.finger) - finger.touching).norm() < kHeight;
    });
  }
  // They then approach the actual object along the normal.
  Descend(path.back(), coming);
  state_ = path.back();
}

void EntryReplay::Descend(const HandState& end, std::vector<Coming>& coming) {
  double way = 0;
  for (Coming& finger : coming) {
    const Vector3d off = control_.TipInObject(finger.finger) - finger.touching;
    finger.height = std::max(0.0, finger.outward.dot(off));
    finger.aside = off - finger.height * finger.outward;
    way = std::max(way, finger.height);
  }
  const HandState begin = state_;
  double gone = 0;
  while (gone < way + kDeepest && !std::ranges::all_of(coming, &Coming::down)) {
    gone += (gone < way - kSlowHeight ? kDescent : kTouchdown) * world_.timestep();
    Run(world_.timestep(), [&](double) {
      state_ = plan::StateBetween(begin, end, way > 0 ? std::min(1.0, gone / way) : 1);
      for (const Coming& finger : coming) {
        if (finger.down) continue;
        // The lateral offset disappears in the first half of the approach.
        const double aside = way > 0 ? std::max(0.0, 1 - 2 * gone / way) : 0;
        control_.LeadTip(finger.finger, finger.touching + (finger.height - gone) * finger.outward +
                                            aside * finger.aside);
      }
    });
    for (Coming& finger : coming) {
      if (finger.down || !control_.Touches(finger.finger)) continue;
      finger.down = true;
      control_.Attach(finger.finger);
    }
  }
  for (const Coming& finger : coming) {
    if (!finger.down) control_.Attach(finger.finger);
    monitor_.WatchPlaced(finger.finger);
  }
  EndIfFailed();
}

void EntryReplay::ReleaseFingers(const plan::Switch& change) {
  monitor_.SetPhase("while a finger breaks contact");
  for (const FingerIndex f : change.release) control_.Detach(f);
  const TimedPath timed(change.motion->release, kFreeJoints);
  const double duration = timed.duration();
  std::vector<FingerIndex> near = change.release;
  Run(duration, [&](double share) {
    state_ = timed.At(share * duration);
    std::erase_if(near, [this](FingerIndex f) {
      if (control_.GapOf(f) < kClear) return false;
      control_.LetOffsetGo(f);
      return true;
    });
  });
  for (const FingerIndex f : near) control_.LetOffsetGo(f);
}

void EntryReplay::Rest() {
  monitor_.SetPhase("while settling");
  Run(kSettle, [](double) {});
  monitor_.SetPhase("in the static grasp");
  monitor_.SetSettling(false);
  monitor_.WatchRest(state_.pose);
  monitor_.WatchTipsAtRest();
  EndIfFailed();
}

void EntryReplay::Freeze() {
  if (freeze_s_ == 0) return;
  const Isometry3d start = world_.object_pose();
  const auto steps = static_cast<int>(std::lround(freeze_s_ / world_.timestep()));
  const auto still_steps = static_cast<int>(std::lround(kFrozenStillTime / world_.timestep()));
  double first = 0;  // speed at the start of the time in which all is still
  int still = 0;
  for (int i = 0; i < steps && monitor_.measures().frozen_off_m < kFallen; ++i) {
    world_.Step();
    monitor_.WatchFrozen(start);
    const double speed = world_.largest_speed();
    if (still == 0) first = speed;
    still = speed < kFrozenStill ? still + 1 : 0;
    if (still >= still_steps && speed < first) break;
  }
  monitor_.CheckFrozen(start);
  EndIfFailed();
  world_.Restore(rest_);
}

void EntryReplay::ApplyDisturbances() {
  const double disturbance_N = disturbance_ratio_ * grasp_force_;
  if (disturbance_N == 0 || monitor_.violation()) return;
  disturbing_ = true;
  const HandControl control = control_;
  const ExecutionMonitor monitor = monitor_;
  for (const Disturbance& disturbance : DisturbanceDirections(3)) {
    const std::string name = DisturbanceText(disturbance, disturbance_N, radius_);
    monitor_.SetPhase("under " + name);
    const grasp::Wrench wrench = DisturbanceWrench(disturbance, disturbance_N);
    const Vector3d torque = radius_ * wrench.torque_over_radius;
    monitor_.SetDisturbance({wrench.force, torque, name});
    Run(kHandDisturbanceRamp,
        [&](double share) { world_.SetLoad(share * wrench.force, share * torque); });
    Run(kDisturbanceHold, [](double) {});
    monitor_.WatchRest(state_.pose);
    if (monitor_.violation()) throw StepFails();
    world_.SetLoad(Vector3d::Zero(), Vector3d::Zero());
    world_.Restore(rest_);
    control_.CopyState(control);
    monitor_.CopyState(monitor);
  }
  disturbing_ = false;
}

}  // namespace regrasp::sim
