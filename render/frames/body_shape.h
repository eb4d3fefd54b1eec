#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/object.h"

namespace regrasp::render {

/// Triangles with a normal at each corner; flat facets have three equal ones.
struct FacetMesh {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<std::array<Eigen::Vector3d, 3>> normals;

  void AddFlat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
};

/// The same surface seen from its other side.
[[nodiscard]] FacetMesh TurnInsideOut(FacetMesh mesh);

/// What is drawn of an object: its true surface and the edges between its faces.
struct BodyShape {
  FacetMesh surface;
  std::vector<std::array<Eigen::Vector3d, 2>> edges;
};

/// Thickness of the prism that stands for a polygon where none is given, in diameters.
inline constexpr double kUsualThickness = 0.25;

/// The shape of an object about its centroid in units of its diameter. A polygon becomes a prism
/// of `thickness` (diameters) whose top lies in the plane z = 0, a hair above it: contacts, fingers
/// and cones, which are drawn at z = 0, are then seen on its outline and before it.
///
/// Edges between faces that meet at less than 5° are left out: on finely meshed curved bodies they
/// would cover everything else.
[[nodiscard]] BodyShape MakeBodyShape(const object::Object& object,
                                      double thickness = kUsualThickness);

/// A closed cone with apex at the origin that opens along +z.
[[nodiscard]] FacetMesh MakeCone(double half_angle, double slant);

/// A flat friction cone: a triangle in the plane y = 0 with apex at the origin that opens along +z,
/// as a thin closed plate on the positive side of y.
[[nodiscard]] FacetMesh MakeWedge(double half_angle, double slant);

/// The distance along the ray from `origin` in unit `direction` to the first triangle, infinite
/// where there is none. Hits nearer than `skip` do not count.
[[nodiscard]] double RayDistance(const FacetMesh& mesh, const Eigen::Vector3d& origin,
                                 const Eigen::Vector3d& direction, double skip);

}  // namespace regrasp::render
