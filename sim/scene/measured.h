#pragma once

#include <map>

#include "planner/grasp/finger_friction.h"

namespace regrasp::sim {

// What a replay measures, as plain values: the reports hold them.

/// Shares of the travel of an align, summed over its contacts, by how it is carried out. They sum
/// to 1; for an align that only turns normals they are shares of the subpaths between waypoints.
struct AlignShares {
  double imitated = 0;
  double slid = 0;         ///< while the other fingers alone hold the object
  double best_effort = 0;  ///< slid although they do not, or rolled: nothing else is valid
};

/// How an align was carried out; kNone for other steps.
enum class AlignMode { kNone, kImitated, kSlid, kMixed };

/// The smallest margin that each finger came to, radians, by the finger's number. A finger that
/// never pressed has none.
using FingerMargins = std::map<FingerIndex, double>;

/// A direction in which an object at rest is pushed or turned.
struct Push {
  bool turn = false;  ///< about the axis, instead of along it
  int axis = 0;       ///< 0 x, 1 y, 2 z
  double sign = 1;    ///< +1 or −1
};

/// The largest push that a grasp at rest resists in one direction, over the squeeze (a torque also
/// over R), on top of the weight, its forces adapted to the push.
struct DirectionStress {
  Push push;
  /// The largest push that the object was seen to stand in the replay, found by bisection; 0 where
  /// not even the least was.
  double replay = 0;
  /// The largest push that forces inside the cones with the same squeeze balance, at the contacts
  /// as planned (planner/grasp/largest_load.h); 0 where they do not even carry the weight.
  double analysis = 0;
};

/// What a replay by a hand measures of a step, against the plan.
struct HandMeasures {
  double off_m = 0;       ///< largest distance of the object's centroid from its planned place
  double off_rad = 0;     ///< the same of its orientation
  double rest_off_m = 0;  ///< at rest after the step
  double rest_off_rad = 0;
  double slip_m = 0;           ///< largest slide of a holding tip
  double roll_m = 0;           ///< largest way of a contact on the object while its finger holds
  double torque_share = 0;     ///< largest torque of an actuator over its limit
  double torque_Nm = 0;        ///< largest torque about an independent joint
  double control_limit_s = 0;  ///< longest total time of a control at an end of its range
  double coupling_rad = 0;     ///< largest residual of a coupling of joints
  double tip_depth_m = 0;      ///< largest depth in the object of what touches it
  /// Largest depth at rest of the model's collision geometry of a fingertip that a sphere replaces.
  double covered_depth_m = 0;
  double simulated_s = 0;  ///< without the shakes
};

/// A finger of a grasp, by its number in the hand, and what it needs of its own friction.
struct NeedOfFinger {
  FingerIndex finger = {};
  grasp::FingerFriction friction;
};

}  // namespace regrasp::sim
