#include "sim/hand_grasps/grasp_protocols.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/object/rotation.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Closing of the hand in DexGraspBench: commands per phase, and time steps per command.
constexpr int kCommands = 10;
constexpr int kStepsPerCommand = 10;
/// Load phase of DexGraspBench: checks, time steps between them, and acceleration in m/s².
constexpr int kBenchChecks = 10;
constexpr int kBenchSteps = 50;
constexpr double kBenchAcceleration = 10;
constexpr double kBenchDepth = 0.01;   ///< largest depth at the start, metres
constexpr double kBenchMotion = 0.05;  ///< limit of the translation, metres
constexpr double kBenchAngleDeg = 15;
/// Gravity and time of the fall test of MultiGripperGrasp.
constexpr double kFallGravity = 9.81;
constexpr double kFallSeconds = 3;
/// An object that the hand does not touch for this time is dropped, seconds.
constexpr double kUntouchedSeconds = 0.1;
/// Disturbance test: duration of a force in time steps, limits of the motion, range of forces in
/// newtons, and largest ratio of the bounds.
constexpr int kDisturbanceSteps = 125;
constexpr double kDisturbanceMotion = 0.01;
/// Time steps between checks whether a force is certainly resisted, and factor on the motion that
/// remains at the present speed.
constexpr int kSettleSteps = 15;
constexpr double kSettleFactor = 5;
constexpr double kLeastForce = 0.05;
constexpr double kMostForce = 50;
constexpr double kForceRatio = 1.1;
/// Motion of joints per contact that moves links into the object, if a grasp has no `target`
/// configuration: rad per metre of moment arm as in DexGraspNet, and metres of prismatic joints.
constexpr double kTargetGain = 1;
constexpr double kTargetSlide = 5e-3;
/// Tolerance of joint ranges, rad or metres: data sets store float32.
constexpr double kRangeTolerance = 1e-3;

double AngleDeg(const Isometry3d& from, const Isometry3d& to) {
  return Degrees(object::RotationInBody(from.linear(), to.linear()).angle());
}

/// The tests of one grasp in one world.
class GraspTester {
 public:
  GraspTester(const HandGrasp& grasp, const object::Object& object, const GraspGeometry& geometry,
              const GraspTest& test, GraspWorld& world)
      : grasp_(grasp), object_(object), geometry_(geometry), test_(test), world_(world) {
    world.SetPhysics({.mu = test.mu, .mass_kg = test.mass_kg});
    world.Place(grasp.grasp);
    verdict_.touches = geometry.Measure(world);
    verdict_.distance_m = SmallestDistance(verdict_.touches);
    // A target of the data set may exceed joint ranges, because it is a command.
    target_ = grasp.target            ? *grasp.target
              : grasp.closing.empty() ? world.WithinRange(DerivedTarget())
                                      : world.Closed(grasp.grasp, grasp.closing, "closing");
  }

  void Run(GraspProtocol protocol) {
    ProtocolResult& result = verdict_.results.emplace_back();
    result.protocol = protocol;
    try {
      switch (protocol) {
        case GraspProtocol::kAnalytic:
          return Analyse(result);
        case GraspProtocol::kDexGraspBench:
          return Bench(result);
        case GraspProtocol::kFall:
          return Fall(result);
        case GraspProtocol::kDisturbance:
          return Disturb(result);
      }
    } catch (const UnstableError&) {
      result.fault = GraspFault::kUnstable;
      closed_.reset();
    }
  }

  [[nodiscard]] GraspVerdict verdict() && { return std::move(verdict_); }

 private:
  /// Return the grasp with its links in contact moved towards the object.
  [[nodiscard]] HandConfiguration DerivedTarget() const {
    HandConfiguration target = grasp_.grasp;
    for (const LinkTouch& touch : verdict_.touches) {
      if (touch.contacts.empty()) continue;
      const auto nearest =
          std::ranges::min_element(touch.contacts, {}, &collision::SurfaceContact::gap);
      const auto motion = world_.JointMotion(touch.link, nearest->point, -nearest->outward);
      for (const GraspWorld::JointRange& joint : world_.joints()) {
        const auto found = target.joints.find(joint.name);
        if (found == target.joints.end()) continue;
        found->second += (joint.slides ? kTargetSlide : kTargetGain) * motion.at(joint.name);
      }
    }
    return target;
  }

  [[nodiscard]] bool IsOutOfRange() const {
    return std::ranges::any_of(world_.joints(), [&](const GraspWorld::JointRange& joint) {
      const auto found = grasp_.grasp.joints.find(joint.name);
      return joint.limited && found != grasp_.grasp.joints.end() &&
             (found->second < joint.lower - kRangeTolerance ||
              found->second > joint.upper + kRangeTolerance);
    });
  }

  [[nodiscard]] grasp::Grasp ContactsOfGrasp() const {
    grasp::Grasp contacts;
    for (const LinkTouch& touch : verdict_.touches) {
      for (const collision::SurfaceContact& contact : touch.contacts) {
        contacts.push_back({contact.point / grasp_.scale, -contact.outward.normalized()});
      }
    }
    return contacts;
  }

  void Analyse(ProtocolResult& result) const {
    const grasp::Grasp contacts = ContactsOfGrasp();
    if (IsOutOfRange()) {
      result.fault = GraspFault::kJointsOutOfRange;
    } else if (verdict_.distance_m < -kMostGraspDepth) {
      result.fault = GraspFault::kPenetrates;
    } else if (contacts.empty()) {
      result.fault = GraspFault::kNoContact;
    } else if (!grasp::IsForceClosure(contacts, object_.wrench_frame(), std::atan(test_.mu))) {
      result.fault = GraspFault::kNotForceClosure;
    } else {
      result.quality =
          grasp::BoundQuality(contacts, object_.wrench_frame(), std::atan(test_.mu)).lower;
    }
  }

  void Move(const HandConfiguration& from, const HandConfiguration& to) {
    for (int command = 1; command <= kCommands; ++command) {
      world_.Command(from, to, static_cast<double>(command) / kCommands);
      for (int step = 0; step < kStepsPerCommand; ++step) world_.Step();
    }
  }

  /// Close the hand around the object, once for all directions and protocols.
  void Close() {
    if (closed_) return;
    world_.Place(grasp_.pregrasp ? *grasp_.pregrasp : grasp_.grasp);
    world_.SetForce(Vector3d::Zero());
    if (grasp_.pregrasp) Move(*grasp_.pregrasp, grasp_.grasp);
    Move(grasp_.grasp, target_);
    closed_ = world_.Save();
    is_touched_ = world_.IsTouched();
    closed_object_ = world_.palm_pose().inverse() * world_.object_pose();
  }

  /// Return the fault of a test that fails: kNoContact if the closed hand does not touch the
  /// object.
  [[nodiscard]] GraspFault FaultAfterClosing(GraspFault fault) const {
    return is_touched_ ? fault : GraspFault::kNoContact;
  }

  void Load(const Vector3d& force) {
    world_.Restore(*closed_);
    world_.SetForce(force);
  }

  void Bench(ProtocolResult& result) {
    closed_.reset();
    world_.Place(grasp_.pregrasp ? *grasp_.pregrasp : grasp_.grasp);
    const double distance =
        grasp_.pregrasp ? SmallestDistance(geometry_.Measure(world_)) : verdict_.distance_m;
    if (std::min(distance, world_.SelfDistance()) < -kBenchDepth) {
      result.fault = GraspFault::kPenetrates;
      return;
    }
    Close();
    result.moved_m = result.rotated_deg = 0;
    for (int direction = 0; direction < kLoadDirections; ++direction) {
      Load(kBenchAcceleration * test_.mass_kg * LoadDirection(direction));
      for (int check = 0; check < kBenchChecks; ++check) {
        for (int step = 0; step < kBenchSteps; ++step) world_.Step();
        const Isometry3d pose = world_.object_pose();
        result.moved_m = std::max(*result.moved_m, pose.translation().norm());
        result.rotated_deg = std::max(*result.rotated_deg, AngleDeg(Isometry3d::Identity(), pose));
        if (*result.moved_m < kBenchMotion && *result.rotated_deg < kBenchAngleDeg) continue;
        result.fault = FaultAfterClosing(GraspFault::kObjectMoved);
        return;
      }
    }
  }

  /// Check the conditions of fall and disturbance, and close the hand.
  bool Begin(ProtocolResult& result) {
    if (verdict_.distance_m < -kMostGraspDepth) {
      result.fault = GraspFault::kPenetrates;
      return false;
    }
    Close();
    return true;
  }

  /// Return the time until the object is dropped, at most kFallSeconds.
  double HeldSeconds(int direction) {
    Load(kFallGravity * test_.mass_kg * LoadDirection(direction));
    const int steps = static_cast<int>(std::lround(kFallSeconds / GraspWorld::kTimestep));
    int touched = 0;
    for (int step = 1; step <= steps; ++step) {
      world_.Step();
      if (world_.IsTouched()) touched = step;
      if ((step - touched) * GraspWorld::kTimestep > kUntouchedSeconds) {
        return touched * GraspWorld::kTimestep;
      }
    }
    return kFallSeconds;
  }

  void Fall(ProtocolResult& result) {
    if (!Begin(result)) return;
    result.seconds.assign(kLoadDirections, std::nullopt);
    for (int direction = 0; direction < kLoadDirections; ++direction) {
      result.seconds[direction] = HeldSeconds(direction);
      if (*result.seconds[direction] >= kFallSeconds) continue;
      result.fault = FaultAfterClosing(GraspFault::kDropped);
      return;
    }
  }

  /// Motion of the object in the hand since it has closed.
  struct HeldMotion {
    double moved = 0;  ///< translation of the centroid, metres
    double rotated_deg = 0;
  };

  [[nodiscard]] HeldMotion MotionInHand() const {
    const Isometry3d pose = world_.palm_pose().inverse() * world_.object_pose();
    const Vector3d& centroid = world_.centroid();
    return {(pose * centroid - closed_object_ * centroid).norm(), AngleDeg(closed_object_, pose)};
  }

  /// Return whether the hand holds the object against a force. The simulation ends early if the
  /// object would remain within the limits at a multiple of its present speed.
  bool IsResisted(int direction, double force) {
    Load(force * LoadDirection(direction));
    HeldMotion last;
    for (int step = 1; step <= kDisturbanceSteps; ++step) {
      world_.Step();
      const HeldMotion now = MotionInHand();
      if (now.moved > kDisturbanceMotion || now.rotated_deg > kBenchAngleDeg) return false;
      if (step % kSettleSteps != 0) continue;
      const double left = kSettleFactor * (kDisturbanceSteps - step) / kSettleSteps;
      if (now.moved + left * std::abs(now.moved - last.moved) < kDisturbanceMotion &&
          now.rotated_deg + left * std::abs(now.rotated_deg - last.rotated_deg) < kBenchAngleDeg) {
        break;
      }
      last = now;
    }
    return world_.IsTouched();
  }

  /// Return the largest resisted force by bisection of its logarithm; 0 below kLeastForce.
  double LargestResisted(int direction, double required) {
    double low = kLeastForce;
    double high = kMostForce;
    (IsResisted(direction, required) ? low : high) = required;
    if (high == required && !IsResisted(direction, low)) return 0;
    while (high / low > kForceRatio) {
      const double force = std::sqrt(low * high);
      (IsResisted(direction, force) ? low : high) = force;
    }
    return low;
  }

  void Disturb(ProtocolResult& result) {
    if (!Begin(result)) return;
    const double required = kBenchAcceleration * test_.mass_kg;
    for (int direction = 0; direction < kLoadDirections; ++direction) {
      result.resisted_N.push_back(LargestResisted(direction, required));
      if (result.resisted_N.back() >= required) continue;
      result.fault = FaultAfterClosing(GraspFault::kForceNotResisted);
      return;
    }
  }

  const HandGrasp& grasp_;
  const object::Object& object_;
  const GraspGeometry& geometry_;
  GraspTest test_;
  GraspWorld& world_;
  GraspVerdict verdict_;
  HandConfiguration target_;
  std::optional<EngineState> closed_;                  ///< state after the hand has closed
  bool is_touched_ = false;                            ///< whether the hand then touches the object
  Isometry3d closed_object_ = Isometry3d::Identity();  ///< object in the palm's frame then
};

}  // namespace

std::string_view GraspProtocolName(GraspProtocol protocol) {
  constexpr std::array<std::string_view, 4> kNames = {"analytic", "dexgraspbench", "fall",
                                                      "disturbance"};
  return kNames[static_cast<std::size_t>(protocol)];
}

std::string_view GraspFaultName(GraspFault fault) {
  constexpr std::array<std::string_view, 9> kNames = {
      "none",       "joints-out-of-range", "penetrates",
      "no-contact", "not-force-closure",   "object-moved",
      "dropped",    "force-not-resisted",  "unstable"};
  return kNames[static_cast<std::size_t>(fault)];
}

GraspFault GraspVerdict::fault() const {
  const auto failed =
      std::ranges::find_if(results, [](const ProtocolResult& result) { return !result.passed(); });
  return failed == results.end() ? GraspFault::kNone : failed->fault;
}

Vector3d LoadDirection(int direction) {
  return (direction % 2 == 0 ? -1 : 1) * Vector3d::Unit(direction / 2);
}

GraspVerdict TestHandGrasp(const HandGrasp& grasp, const object::Object& object,
                           const GraspGeometry& geometry,
                           const std::vector<GraspProtocol>& protocols, const GraspTest& test,
                           GraspWorld& world) {
  world.CheckJoints(grasp.grasp, "grasp");
  if (grasp.pregrasp) world.CheckJoints(*grasp.pregrasp, "pregrasp");
  if (grasp.target) world.CheckJoints(*grasp.target, "target");
  GraspTester tester(grasp, object, geometry, test, world);
  for (const GraspProtocol protocol : protocols) tester.Run(protocol);
  return std::move(tester).verdict();
}

}  // namespace regrasp::sim
