#pragma once

#include <map>
#include <string>

#include "planner/grasp/required_friction_angle.h"
#include "planner/plan/reason.h"

namespace regrasp::sim {

// Measurements of a replay as plain values, which reports contain.

/// Shares of the travel of a sliding step, summed over its contacts, by the kind of motion. They
/// sum to 1. If the step only turns normals, they are shares of the subpaths between waypoints.
struct AlignShares {
  double imitated = 0;
  double slid = 0;         ///< the other fingers alone hold the object
  double best_effort = 0;  ///< slid although they do not, or rolled: no other execution is valid
};

/// Execution of a sliding step; kNone for other steps.
enum class AlignMode { kNone, kImitated, kSlid, kMixed };

/// The first limit that a step violates in a replay.
struct Violation {
  plan::Reason reason = plan::Reason::kNone;
  std::string detail;  ///< finger, number, limit and phase of the step, for people
  plan::Fault fault;   ///< location of the fault, for an image
};

/// The smallest friction margin of each finger, radians, by the finger's number. A finger that
/// never pressed has none.
using FingerMargins = std::map<FingerIndex, double>;

/// Direction of a disturbance force or torque on a static grasp.
struct Disturbance {
  bool turn = false;  ///< torque about the axis instead of force along it
  int axis = 0;       ///< 0 x, 1 y, 2 z
  double sign = 1;    ///< +1 or −1
};

/// The largest disturbance that a static grasp resists in one direction in addition to the weight,
/// over the grasp force (a torque also over R). Finger forces adapt to it.
struct ResistedWrench {
  Disturbance disturbance;
  /// Largest value that the object withstands in the replay, by bisection; 0 if it withstands none.
  double replay = 0;
  /// Largest value that forces inside the cones balance at the planned contacts with the same grasp
  /// force (planner/grasp/grasp_forces.h); 0 if they do not balance the weight.
  double analysis = 0;
};

/// Deviations from the plan and loads in one step of a replay by a hand.
struct HandMeasures {
  double off_m = 0;       ///< largest distance of the object's centroid from the plan
  double off_rad = 0;     ///< rotation off the planned orientation
  double rest_off_m = 0;  ///< deviation in the static grasp after the step
  double rest_off_rad = 0;
  double slip_m = 0;  ///< largest slide of a holding fingertip
  double roll_m = 0;  ///< largest travel of a contact on the object while its finger holds
  /// Largest distance of a contact in the static grasp from its place in the plan. Without rolling
  /// in the plan it includes the distance that contacts roll.
  double contact_off_m = 0;
  double torque_share = 0;     ///< largest torque of an actuator over its limit
  double torque_Nm = 0;        ///< largest torque about an independent joint
  double control_limit_s = 0;  ///< longest total time of a control at an end of its range
  double coupling_rad = 0;     ///< largest residual of a coupling of joints
  double tip_depth_m = 0;      ///< largest depth of a fingertip in the object
  /// Largest depth in static grasps of collision geometry of a fingertip that a sphere replaces.
  double covered_depth_m = 0;
  /// Largest motion of the object's centroid, and rotation, in the static grasp under constant
  /// controls.
  double frozen_off_m = 0;
  double frozen_off_rad = 0;
  bool is_complete = false;  ///< whether the step reached its static grasp
  double grasp_force_N = 0;  ///< grasp force of the static grasp after the step
  double simulated_s = 0;    ///< without the disturbance tests
};

/// A finger of a grasp, by its number in the hand, and the friction that it requires.
struct NeedOfFinger {
  FingerIndex finger = {};
  grasp::FingerFriction friction;
};

}  // namespace regrasp::sim
