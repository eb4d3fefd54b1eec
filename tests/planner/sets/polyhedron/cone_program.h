#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace regrasp::polyhedron {

/// Focus points that see one of some points inside a cone: the convex hull of the corners, and from
/// each of its points the cone of half-angle φ about `axis`. With a zero axis the hull alone.
struct SeenFrom {
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double tangent = 0;  ///< tan φ
};

/// The pyramid that takes the place of a cone.
struct ConePyramid {
  int sides = 8;
  bool circumscribed = false;  ///< otherwise inscribed
};

/// How far inside all of the sets some point is, with pyramids for cones: the largest t for which a
/// point x has
///
///     x = Σ λ_ij c_ij + Σ μ_ir e_ir  for all i,  Σ_j λ_ij = 1,  λ ≥ 0,  μ_ir ≥ t
///
/// with the corners c and the pyramids' edges e, of unit height; positive iff the interiors of the
/// pyramidal sets (of sets without a cone: the sets) meet. By GLPK's simplex method in doubles.
///
/// @param scale  lengths are divided by it.
/// @param reach  x is looked for so many scales from the origin, along each axis.
/// @returns t / scale, at most 1.
[[nodiscard]] double ConeMargin(std::span<const SeenFrom> sets, const ConePyramid& pyramid,
                                double scale, double reach);

/// What pyramids say of the circular cones between them.
enum class Verdict {
  kMeet,     ///< inscribed pyramids have a common interior
  kApart,    ///< circumscribed ones have no point in common
  kTouch,    ///< circumscribed ones have points in common, but no interior
  kBetween,  ///< all else
};

[[nodiscard]] Verdict DecideByPyramids(std::span<const SeenFrom> sets, double scale);

}  // namespace regrasp::polyhedron
