#pragma once

#include <map>

#include "planner/grasp/finger_friction.h"

namespace regrasp::sim {

// Quantities that a replay measures, as plain values for the reports.

/// Shares of the travel of a sliding step, summed over its contacts, by method of execution. They
/// sum to 1. For a sliding step that only turns normals they are shares of the subpaths between
/// waypoints.
struct AlignShares {
  double imitated = 0;
  double slid = 0;  ///< slid while the other fingers alone hold the object
  /// Slid without force closure of the other fingers, or rolled, because nothing else is valid.
  double best_effort = 0;
};

/// Method of execution of a sliding step; kNone for other steps.
enum class AlignMode { kNone, kImitated, kSlid, kMixed };

/// Smallest friction margin by finger, radians. Fingers that never had a contact force are missing.
using FingerMargins = std::map<FingerIndex, double>;

/// Direction of a disturbance force or torque on the object in a static grasp.
struct Push {
  bool turn = false;  ///< torque about the axis instead of force along it
  int axis = 0;       ///< 0 x, 1 y, 2 z
  double sign = 1;    ///< +1 or −1
};

/// Resisted wrench of a static grasp in one direction, over the grasp force (a torque also over R).
/// It acts in addition to the weight, with grasp forces adapted to it.
struct DirectionStress {
  Push push;
  /// Largest disturbance that the object withstands in the replay, found by bisection; 0 if it does
  /// not withstand the smallest.
  double replay = 0;
  /// Largest disturbance that forces inside the cones with the same grasp force balance, at the
  /// planned contacts (planner/grasp/largest_load.h). 0 if they do not balance the weight.
  double analysis = 0;
};

/// Measurements of a step in a replay with a hand, relative to the plan.
struct HandMeasures {
  double off_m = 0;       ///< largest distance of the object's centroid from its planned position
  double off_rad = 0;     ///< largest deviation of its orientation
  double rest_off_m = 0;  ///< distance in the hold phase after the step
  double rest_off_rad = 0;
  double slip_m = 0;  ///< largest slip of a fingertip in contact
  double roll_m = 0;  ///< largest path of a contact on the object while its finger is in contact
  double torque_share = 0;     ///< largest torque of an actuator over its limit
  double torque_Nm = 0;        ///< largest torque about an independent joint
  double control_limit_s = 0;  ///< longest total time of a control at an end of its range
  double coupling_rad = 0;     ///< largest residual of a joint coupling
  /// Largest penetration depth in the object of the geometry that touches it.
  double tip_depth_m = 0;
  /// Largest penetration depth, in hold phases, of the fingertip collision geometry of the model
  /// that a sphere replaces.
  double covered_depth_m = 0;
  double simulated_s = 0;  ///< simulated time without disturbance tests
};

/// Finger of a grasp by its number in the hand, and its required friction.
struct NeedOfFinger {
  FingerIndex finger = {};
  grasp::FingerFriction friction;
};

}  // namespace regrasp::sim
