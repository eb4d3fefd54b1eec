#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"

namespace regrasp::render {

/// How a planar grasp is drawn (Phoka 2010, section 3.2).
enum class DiagramKind {
  kTwoFinger,   ///< friction cones and the line through the contacts
  kConcurrent,  ///< double-sided friction cones, focus point and focus cell
  kParallel,    ///< the common cone at every contact, parallel lines of force
  kOther,       ///< friction cones alone: more than three contacts, or of none of these types
};

/// The points apex ± s·d, s ≥ 0, d within `half_angle` of `axis`.
struct DoubleCone {
  Eigen::Vector2d apex;
  Eigen::Vector2d axis;   ///< unit, on the inner side of the edge
  double half_angle = 0;  ///< radians
};

/// A convex polygon, counter-clockwise.
using Outline = std::vector<Eigen::Vector2d>;

/// What a figure shows of a planar grasp at rest, in the object's own units.
struct GraspDiagram {
  DiagramKind kind = DiagramKind::kOther;
  /// One per contact, in the grasp's order: of half-angle φ = min(θ, φ*) for a concurrent grasp,
  /// the common cone for a parallel one, otherwise of half-angle θ.
  std::vector<DoubleCone> cones;
  std::optional<Eigen::Vector2d> focus;            ///< of a concurrent grasp
  std::vector<Outline> focus_cell;                 ///< convex parts of the focus cell of its edges
  std::optional<Eigen::Vector2d> force_direction;  ///< unit; of a parallel grasp
};

/// Decides how a grasp is drawn and computes what is drawn.
///
/// Three contacts are concurrent if their normals positively span the plane and their double-sided
/// cones of half-angle φ = min(θ, φ*), φ* = (π − largest gap between neighbouring normals) / 2,
/// have a common interior. They are parallel if a direction in the common cone −C_a ∩ C_b ∩ C_c
/// exists whose line through p_a separates p_b from p_c (Phoka 2010, Prop. 3.8). Where they are
/// both, the type with the wider cones is drawn. Two contacts are a 2-finger grasp if the line
/// through them is inside both cones and they press towards or away from each other. All in
/// doubles: a grasp on the very border of a type may be drawn as another.
///
/// The focus point is the centroid of the largest part of the cones' intersection: a point well
/// inside, as any point there will do.
///
/// Laws: independent of the order of the contacts but for the order of `cones`; moves with the
/// object under rigid motion and scaling.
/// @param grasp       contacts with their faces, as LocatePlan gives them.
/// @param half_angle  θ, radians.
/// @throws std::invalid_argument  a contact has no face, or θ is not in (0, π/2).
[[nodiscard]] GraspDiagram DescribeGrasp(const object::Polygon& polygon, const grasp::Grasp& grasp,
                                         double half_angle);

}  // namespace regrasp::render
