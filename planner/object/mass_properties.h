#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace regrasp::object {

/// Volume (area in the plane), centroid and inertia of a homogeneous solid of density 1.
///
/// In the plane the solid is a sheet of thickness 1: `volume` is the area, and `inertia` holds the
/// second moments of the area about the centroid, its (2,2) entry the polar one.
struct MassProperties {
  double volume = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centroid, along the axes
};

/// The mass properties of the solid that closed, outward oriented triangles bound.
///
/// Sums of signed tetrahedra from one vertex: with a, b, c a triangle's corners and s = a + b + c,
/// V = Σ v, v = a·(b × c)/6; ∫x = Σ v s/4; ∫xxᵀ = Σ v (ssᵀ + aaᵀ + bbᵀ + ccᵀ)/20 (Tonon 2004).
/// Exact for polyhedra up to rounding. Laws: turning the orientation negates volume and inertia;
/// moves, turns and scales (V s³, I s⁵) with the solid.
/// @returns zeros and a volume ≤ 0 where the triangles enclose none.
[[nodiscard]] MassProperties ComputeMassProperties(
    const std::vector<Eigen::Vector3d>& vertices, const std::vector<std::array<int, 3>>& triangles);

/// The mass properties of the sheet that rings bound, the outer one counter-clockwise, holes
/// clockwise. The same sums over signed triangles: with a, b an edge's ends and c = a × b,
/// A = Σ c/2; ∫x = Σ c (a + b)/6; ∫xxᵀ = Σ c ((a + b)(a + b)ᵀ + aaᵀ + bbᵀ)/24.
[[nodiscard]] MassProperties ComputeMassProperties(
    const std::vector<std::vector<Eigen::Vector2d>>& rings);

}  // namespace regrasp::object
