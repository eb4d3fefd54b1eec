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
  kHandJumps,
  kTipOffContact,
  kJointLimit,
  kHandCollides,
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
};

}  // namespace regrasp::plan
