#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

// Definition of concurrent, 2-finger and parallel planar grasps, written again as simply as
// possible in doubles, contact by contact. It shares only the names of the types with
// planner/sets/polygon.

/// Kind of a grasp as decided in doubles.
struct DirectKind {
  GraspType type;
  int part;      ///< see GraspSet::parts, for contacts in the order of their edges
  bool certain;  ///< false if the decision is within kDirectMargin
};

/// Margin of a decision, relative to `size` for lengths, in rad for angles.
inline constexpr double kDirectMargin = 1e-9;

/// Return the angle φ of the cones of three contacts in concurrent grasps; 0 if their normals do
/// not span.
[[nodiscard]] double ConcurrentFrictionAngle(std::span<const grasp::Contact> contacts,
                                             double friction_angle, planning::Spanning spanning);

/// Return the kinds of two contacts.
///
/// In a grasp from outside, each contact is in the cone of its opposite. In a stretching grasp,
/// each contact is in the reversed cone.
[[nodiscard]] std::vector<DirectKind> KindsOfTwo(std::span<const grasp::Contact> contacts,
                                                 double friction_angle);

/// Return the kinds of three contacts.
///
/// Concurrent: the normals span, and the cones, on the sides given by the part, have a common
/// interior; found by clipping a huge square. Parallel: there is a direction w in −C(n_a), C(n_b)
/// and C(n_c) for which the lines along w through p_b and p_c are on different sides of the line
/// through p_a. The part is a.
[[nodiscard]] std::vector<DirectKind> KindsOfThree(std::span<const grasp::Contact> contacts,
                                                   double friction_angle,
                                                   planning::Spanning spanning, double size);

}  // namespace regrasp::polygon
