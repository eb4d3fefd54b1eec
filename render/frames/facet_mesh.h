#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace regrasp::render {

/// Triangles with a normal at each corner; flat facets have three equal ones.
struct FacetMesh {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<std::array<Eigen::Vector3d, 3>> normals;

  void AddFlat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  void Add(const std::array<Eigen::Vector3d, 3>& corners,
           const std::array<Eigen::Vector3d, 3>& corner_normals);
};

/// The same surface seen from its other side.
[[nodiscard]] FacetMesh TurnInsideOut(FacetMesh mesh);

/// A closed cone with apex at the origin that opens along +z.
[[nodiscard]] FacetMesh MakeCone(double half_angle, double slant);

/// A flat friction cone: a triangle in the plane y = 0 with apex at the origin that opens along +z,
/// as a thin closed plate on the positive side of y.
[[nodiscard]] FacetMesh MakeWedge(double half_angle, double slant);

/// All points within `radius` of the segment from..to, which may be a point.
[[nodiscard]] FacetMesh MakeCapsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                    double radius);

/// The outline of such a capsule, filled: a flat band with round ends across the line of sight and
/// as near to the eye as the capsule is.
/// @param back  unit, towards the eye.
[[nodiscard]] FacetMesh MakeBand(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                 double radius, const Eigen::Vector3d& back);

}  // namespace regrasp::render
