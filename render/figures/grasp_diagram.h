#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"

namespace regrasp::render {

/// Representation of a planar grasp (Phoka 2010, section 3.2).
enum class DiagramKind {
  kTwoFinger,   ///< friction cones and the line through the contacts
  kConcurrent,  ///< double-sided friction cones, focus point and focus cell
  kParallel,    ///< common cone at every contact, and parallel lines of force
  kOther,       ///< friction cones only: more than three contacts, or none of these types
};

/// The points apex ± s·d with s ≥ 0 and the direction d within `friction_angle` of `axis`.
struct DoubleCone {
  Eigen::Vector2d apex;
  Eigen::Vector2d axis;       ///< unit vector to the inner side of the edge
  double friction_angle = 0;  ///< angle between axis and border, radians
};

/// A convex polygon, counter-clockwise.
using Outline = std::vector<Eigen::Vector2d>;

/// The elements of a figure of a planar static grasp, in object units.
struct GraspDiagram {
  DiagramKind kind = DiagramKind::kOther;
  /// One cone per contact, in grasp order. The angle is φ = min(θ, φ*) for a concurrent grasp, that
  /// of the common cone for a parallel grasp, and the friction angle θ otherwise.
  std::vector<DoubleCone> cones;
  std::optional<Eigen::Vector2d> focus;            ///< focus point of a concurrent grasp
  std::vector<Outline> focus_cell;                 ///< convex parts of the focus cell of its edges
  std::optional<Eigen::Vector2d> force_direction;  ///< unit vector; only for a parallel grasp
};

/// Determine the type of a grasp and compute its diagram.
///
/// Let φ* = (π − largest gap between neighbouring normals) / 2 and φ = min(θ, φ*). Three contacts
/// are
///   - concurrent if their normals positively span the plane and their double-sided cones with
///   angle φ have a common interior,
///   - parallel if the common cone −C_a ∩ C_b ∩ C_c contains a direction whose line through p_a
///   separates p_b from p_c (Phoka 2010, Prop. 3.8).
/// A grasp of both types is drawn as the type with the wider cones. Two contacts are a 2-finger
/// grasp if the line through them is inside both cones and the contact forces point towards or away
/// from each other. The computation is in floating point, so that a grasp on the border of a type
/// can be drawn as another type.
///
/// The focus point is the centroid of the largest part of the intersection of the cones. Any other
/// interior point is equivalent. The result does not depend on the order of the contacts, apart
/// from the order of `cones`. It moves with the object under rigid motion and scaling.
/// @param grasp           contacts with their faces, as ProjectPlan returns them.
/// @param friction_angle  friction angle θ, radians.
/// @throws std::invalid_argument  if a contact has no face, or if θ is not in (0, π/2).
[[nodiscard]] GraspDiagram DescribeGrasp(const object::Polygon& polygon, const grasp::Grasp& grasp,
                                         double friction_angle);

}  // namespace regrasp::render
