#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Reason why a step fails. The order is that of the report: of several faults, the first counts.
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
  kNotStatic,
  kStartDiffers,
  kGoalNotReached,
};

/// Return the name of a reason in reports, such as "off-surface"; empty for kNone.
[[nodiscard]] std::string_view ReasonName(Reason reason);

/// Disturbance force on the object, in the replay's world frame.
struct FaultDisturbance {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_Nm = Eigen::Vector3d::Zero();
  std::string name = {};  ///< text for messages: size and direction
};

/// Link of a hand, identified by the joints that move it.
struct HandLink {
  FingerIndex finger = {};  ///< finger; not valid for the palm
  int joints = 0;           ///< number of the finger's joints, from the palm on, that move the link
  bool operator==(const HandLink&) const = default;
};

/// Location of a fault of the hand, from its check: in the palm's frame, metres.
struct HandFaultPlace {
  HandState state;                   ///< state of hand and object at that instant
  std::vector<HandLink> links = {};  ///< links at fault
  /// Location of the fault, and its number for the image: "3.2 mm", "97.4°, limit 90°".
  std::optional<Eigen::Vector3d> at = std::nullopt;
  std::string number = {};
  /// Gap between links that are too close; negative if they overlap.
  std::optional<double> gap_m = std::nullopt;
  /// Fingertip sphere that is away from its contact.
  struct Tip {
    Eigen::Vector3d found, expected;
    double radius;
  };
  std::optional<Tip> tip = std::nullopt;
  /// Expected object pose: its previous pose, or the goal pose.
  std::optional<Eigen::Isometry3d> pose = std::nullopt;
};

/// Fault of a step in a form that can be drawn, made together with the text for messages.
/// Lengths are in the object's frame and unit. Members that do not apply are empty.
struct Fault {
  std::vector<FingerIndex> fingers = {};  ///< fingers at fault; empty for the whole grasp
  /// Actual contact of the first of these fingers, from the plan or from the replay.
  std::optional<grasp::Contact> found = std::nullopt;
  /// Expected contacts: on the surface with the normal there, or the previous ones. For start and
  /// goal: the contacts that no finger has.
  grasp::Grasp expected = {};
  /// Grasp at the instant of the fault, unless it is the static grasp after a step.
  FingerGrasp grasp = {};
  int waypoint = -1;         ///< waypoint of a sliding step at fault or before the fault
  double finger_radius = 0;  ///< radius of fingers that are too thick
  /// Required and actual friction angle for a loss of force closure, radians. `required` is empty
  /// if no angle below 90° is enough.
  std::optional<double> required = std::nullopt;
  std::optional<double> friction_angle = std::nullopt;
  std::optional<FaultDisturbance> disturbance =
      std::nullopt;  ///< disturbance force under which a replay failed
  /// Object pose at the start of a step that fails in the replay.
  std::optional<Eigen::Isometry3d> X_WO_before = std::nullopt;
  std::optional<HandFaultPlace> hand =
      std::nullopt;  ///< place on the hand; only in a plan for a hand
};

}  // namespace regrasp::plan
