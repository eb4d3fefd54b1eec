#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace regrasp::object {

/// Reference point of torques and the length that divides them, so that wrenches have one unit.
///
/// A force f at p is the wrench (f, (p − origin) × f / radius). Every tolerance, grasp quality and
/// disturbance test of the project uses this frame: `origin` is the object's centroid, `radius`
/// half its diameter. In the plane (`dimension` 2), forces are in x and y and the torque is about
/// z.
struct WrenchFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double radius = 1;
  int dimension = 3;
};

/// Volume (area in the plane), centroid and inertia of a homogeneous solid of density 1.
///
/// A planar object is a sheet of thickness 1. Its `volume` is the area. Its `inertia` contains the
/// second moments of area about the centroid; element (2,2) is the polar moment.
struct MassProperties {
  double volume = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  /// Inertia about the centroid, along the coordinate axes.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// Compute the mass properties of the solid bounded by closed, outward oriented triangles.
///
/// The method sums signed tetrahedra from one vertex (Tonon 2004). With a, b, c a triangle's
/// corners, s = a + b + c and v = a·(b × c)/6:
/// - V = Σ v
/// - ∫x = Σ v s/4
/// - ∫xxᵀ = Σ v (ssᵀ + aaᵀ + bbᵀ + ccᵀ)/20
///
/// It is exact for polyhedra up to rounding. Laws: reversing the orientation negates volume and
/// inertia; the result moves, rotates and scales (V s³, I s⁵) with the solid.
/// @returns zeros and a volume ≤ 0 if the triangles enclose no volume.
[[nodiscard]] MassProperties ComputeMassProperties(
    const std::vector<Eigen::Vector3d>& vertices, const std::vector<std::array<int, 3>>& triangles);

/// Compute the mass properties of the sheet bounded by rings.
///
/// Uses the same sums over signed triangles. With a, b an edge's ends and c = a × b:
/// - A = Σ c/2
/// - ∫x = Σ c (a + b)/6
/// - ∫xxᵀ = Σ c ((a + b)(a + b)ᵀ + aaᵀ + bbᵀ)/24
///
/// @param rings  points of each ring: the outer ring counter-clockwise, holes clockwise.
[[nodiscard]] MassProperties ComputeMassProperties(
    const std::vector<std::vector<Eigen::Vector2d>>& rings);

}  // namespace regrasp::object
