#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "planner/object/polyhedron.h"

namespace regrasp::object {

/// Spatial index of the faces of a polyhedron, for queries with points and segments.
///
/// A query takes microseconds for 50,000 triangles. The index stores only the geometry of faces
/// with many triangles or borders. Every query therefore takes the polyhedron from which the index
/// was built, or a copy. Queries are const and thread-safe.
class FaceTree {
 public:
  explicit FaceTree(const Polyhedron& solid);
  ~FaceTree();
  FaceTree(const FaceTree&) = delete;
  FaceTree& operator=(const FaceTree&) = delete;

  /// Same as the functions of Object with these names.
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
