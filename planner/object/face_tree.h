#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "planner/object/polyhedron.h"

namespace regrasp::object {

/// Answers where points and segments lie on the faces of a polyhedron, by trees of boxes.
///
/// A query costs microseconds on meshes of 50 000 triangles. It keeps the geometry of faces with
/// many triangles or borders only: every query is given the polyhedron that the tree was made of,
/// or a copy. Queries are const and safe from several threads.
class FaceTree {
 public:
  explicit FaceTree(const Polyhedron& solid);
  ~FaceTree();
  FaceTree(const FaceTree&) = delete;
  FaceTree& operator=(const FaceTree&) = delete;

  /// As the functions of Object with these names.
  [[nodiscard]] Eigen::Vector3d ClosestPoint(const Polyhedron& solid, FaceIndex face,
                                             const Eigen::Vector3d& point) const;
  [[nodiscard]] std::vector<FaceIndex> FacesNear(const Polyhedron& solid,
                                                 const Eigen::Vector3d& point,
                                                 double tolerance) const;
  [[nodiscard]] std::vector<FaceIndex> FacesNearSegment(const Polyhedron& solid,
                                                        const Eigen::Vector3d& a,
                                                        const Eigen::Vector3d& b,
                                                        double tolerance) const;
  [[nodiscard]] double DistanceToBorder(const Polyhedron& solid, FaceIndex face,
                                        const Eigen::Vector3d& point) const;
  [[nodiscard]] bool ContainsSegment(const Polyhedron& solid, FaceIndex face,
                                     const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                     double tolerance) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace regrasp::object
