#pragma once

#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"

namespace regrasp {

/// Mean normals by adding up small pieces of the surface: slow, and by another way than what
/// planners and the checker go by (object/patch_normal.h).
class PatchJudge {
 public:
  /// @param solid   outlives this object.
  /// @param radius  of the patches, the solid's unit of length.
  PatchJudge(const object::Polyhedron& solid, double radius);

  /// The unit mean of the inward normals, by area, of the surface that is connected with the
  /// contact inside a ball of the radius about it.
  /// @param contact  knows its face.
  [[nodiscard]] Eigen::Vector3d MeanNormal(const grasp::Contact& contact) const;

  /// The same contacts with mean normals.
  [[nodiscard]] grasp::Grasp WithMeanNormals(const grasp::Grasp& grasp) const;

 private:
  [[nodiscard]] object::TriangleIndex TriangleUnder(const grasp::Contact& contact) const;
  [[nodiscard]] double DistanceTo(object::TriangleIndex t, const Eigen::Vector3d& p) const;

  const object::Polyhedron& solid_;
  double radius_;
  std::vector<std::vector<object::TriangleIndex>> triangles_of_vertex_;
};

}  // namespace regrasp
