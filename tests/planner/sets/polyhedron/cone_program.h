#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace regrasp::polyhedron {

/// Focus points that see a point of a convex hull inside a cone. From each point of the hull of the
/// corners, the cone has the angle φ about `axis`. With a zero axis, the set is the hull alone.
struct SeenFrom {
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double tangent = 0;  ///< tan φ of the cone
};

/// Pyramid that approximates a cone.
struct ConePyramid {
  int sides = 8;
  bool circumscribed = false;  ///< false: inscribed
};

/// Compute the depth of the deepest common point of sets, with pyramids instead of cones.
///
/// It is the largest t for which a point x has
///
///     x = Σ λ_ij c_ij + Σ μ_ir e_ir  for all i,  Σ_j λ_ij = 1,  λ ≥ 0,  μ_ir ≥ t
///
/// with the corners c and the pyramids' edges e of unit height. It is positive iff the interiors of
/// the pyramidal sets intersect; sets without a cone count as they are. Solved by GLPK's simplex
/// method in doubles.
///
/// @param scale  length by which all lengths are divided.
/// @param reach  bound on the coordinates of x, in scales from the origin.
/// @returns t / scale, at most 1.
[[nodiscard]] double ConeMargin(std::span<const SeenFrom> sets, const ConePyramid& pyramid,
                                double scale, double reach);

/// Decision about circular cones by inscribed and circumscribed pyramids.
enum class Verdict {
  kMeet,     ///< inscribed pyramids have a common interior
  kApart,    ///< circumscribed pyramids have no common point
  kTouch,    ///< circumscribed pyramids have common points, but no interior
  kBetween,  ///< all remaining cases
};

[[nodiscard]] Verdict DecideByPyramids(std::span<const SeenFrom> sets, double scale);

}  // namespace regrasp::polyhedron
