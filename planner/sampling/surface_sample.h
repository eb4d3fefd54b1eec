#pragma once

#include <vector>

#include "planner/base/random.h"
#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"

namespace regrasp {

/// Draws points evenly over the surface of a solid, by area (Turk 1990). The walls of sealed
/// cavities are no part of it.
class SurfaceSampler {
 public:
  explicit SurfaceSampler(const Polyhedron& solid);

  /// A triangle, by area.
  [[nodiscard]] int DrawTriangle(RandomStream& random) const;

  /// A point with the inward normal of its face.
  [[nodiscard]] Contact Draw(RandomStream& random) const;

  [[nodiscard]] double area() const { return area_up_to_.back(); }

 private:
  const Polyhedron& solid_;
  std::vector<double> area_up_to_;  ///< running sums over the triangles
};

[[nodiscard]] double TriangleArea(const Polyhedron& solid, int triangle);

/// The contact at a point of a triangle of the solid: its face's normal, p on the face.
[[nodiscard]] Contact ContactOnTriangle(const Polyhedron& solid, int triangle,
                                        const Eigen::Vector3d& p);

}  // namespace regrasp
