#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

// What makes a planar grasp concurrent, 2-finger or parallel, written down once more in doubles and
// as plainly as can be, contact by contact. Nothing of planner/sets/polygon but the names of the
// types.

/// A kind of grasp that contacts are, as far as doubles can tell.
struct DirectKind {
  GraspType type;
  int part;      ///< as GraspSet::parts has it, for contacts in the order of their edges
  bool certain;  ///< false within kDirectMargin of the border between yes and no
};

/// Relative to `size` for lengths, radians for angles.
inline constexpr double kDirectMargin = 1e-9;

/// The half-angle that three contacts' cones have in concurrent grasps; 0 where their normals don't
/// span.
[[nodiscard]] double ConcurrentHalfAngle(std::span<const grasp::Contact> contacts,
                                         double half_angle, planning::Spanning spanning);

/// Squeezing: the second contact in the first one's cone and the other way round. Stretching: both
/// behind.
/// @param size  of the polygon.
[[nodiscard]] std::vector<DirectKind> KindsOfTwo(std::span<const grasp::Contact> contacts,
                                                 double half_angle);

/// Concurrent: the normals span, and the cones (for each part on given sides) have a common
/// interior; found by clipping a huge square.
/// Parallel: for some direction w in −C(n_a), C(n_b) and C(n_c) the lines along w through p_b and
/// p_c are on different sides of the one through p_a; a is the part.
[[nodiscard]] std::vector<DirectKind> KindsOfThree(std::span<const grasp::Contact> contacts,
                                                   double half_angle, planning::Spanning spanning,
                                                   double size);

}  // namespace regrasp::polygon
