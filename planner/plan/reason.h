#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Why a step fails, in the order of the report: where a step has several faults, the first counts.
enum class Reason {
  kNone,
  kOffSurface,
  kWrongNormal,
  kFingerNotFree,
  kFingerNotHolding,
  kTooManyFingers,
  kCoincidentFingers,
  kDiscontinuous,
  kLeavesFace,
  kNotForceClosure,
  kNotProved,
  kUnreachable,
  kOffPoint,
  kHandJumps,
  kTipOffContact,
  kJointLimit,
  kHandCollides,
  kTorqueLimit,
  kCouplingViolated,
  kTipPenetrates,
  kSimulationUnstable,
  kContactLost,
  kSlipped,
  kObjectMoved,
  kStartDiffers,
  kGoalNotReached,
};

/// "off-surface" and so on, as the report spells it; empty for kNone.
[[nodiscard]] std::string_view ReasonName(Reason reason);

/// A push on the object, in the replay's world frame.
struct FaultPush {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_Nm = Eigen::Vector3d::Zero();
  std::string name = {};  ///< for people: "a push of 5.3 N along +x"
};

/// A link of a hand, by what moves it.
struct HandLink {
  FingerIndex finger = {};  ///< not valid: the palm
  int joints = 0;           ///< of the finger, from the palm on, that move it
  bool operator==(const HandLink&) const = default;
};

/// Where a plan's hand fails, as its check saw it: in the palm's frame, metres.
struct HandFaultPlace {
  HandState state;                   ///< of hand and object at that instant
  std::vector<HandLink> links = {};  ///< at fault
  /// Where they are, and the number that tells it: "3.2 mm", "97.4°, limit 90°".
  std::optional<Eigen::Vector3d> at = std::nullopt;
  std::string number = {};
  /// Between links that are too near; negative where they are in each other.
  std::optional<double> gap_m = std::nullopt;
  /// The ball of a tip that is not where it touches its contact.
  struct Tip {
    Eigen::Vector3d found, expected;
    double radius;
  };
  std::optional<Tip> tip = std::nullopt;
  /// Where the object should be: where it was, or at its goal.
  std::optional<Eigen::Isometry3d> pose = std::nullopt;
};

/// Where a step fails, as far as it can be drawn; it stands beside the text for people, and both
/// are made at one place. Lengths in the object's frame and unit; what does not apply is empty.
struct Fault {
  std::vector<FingerIndex> fingers = {};  ///< at fault; none where it is the whole grasp
  /// Where the first of them is, as given in the plan or as the replay saw it …
  std::optional<grasp::Contact> found = std::nullopt;
  /// … and where it should be: on the surface with the normal there, or where it was before. Of
  /// start and goal: the contacts that no finger has.
  grasp::Grasp expected = {};
  /// The contacts that hold at the instant of the fault, where that is no rest after a step.
  FingerGrasp grasp = {};
  int waypoint = -1;         ///< of an align: the one at fault, or before it
  double finger_radius = 0;  ///< of fingers that are too thick
  /// The friction half-angle that is needed, none where none below 90° serves, and the one that
  /// there is, radians; of a loss of force closure.
  std::optional<double> required = std::nullopt;
  std::optional<double> half_angle = std::nullopt;
  std::optional<FaultPush> push = std::nullopt;  ///< that a replay failed under
  /// Where the object was at the start of a step that fails in the replay.
  std::optional<Eigen::Isometry3d> X_WO_before = std::nullopt;
  std::optional<HandFaultPlace> hand = std::nullopt;  ///< of a plan for a hand
};

}  // namespace regrasp::plan
