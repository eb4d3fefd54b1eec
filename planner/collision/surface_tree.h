#pragma once

#include <Eigen/Core>

#include "planner/collision/convex_shape.h"
#include "planner/object/polyhedron.h"
#include "planner/object/triangle_tree.h"

namespace regrasp::collision {

/// Surface of a solid as a tree of triangles, for distances from it in metres.
/// A shape wholly inside the solid has a positive distance too. This suffices because paths that
/// begin outside and avoid the surface stay outside.
class SurfaceTree {
 public:
  /// @param solid  solid in object units.
  /// @param scale  metres per object unit.
  SurfaceTree(const object::Polyhedron& solid, double scale);

  /// Return a certified lower bound of the distance of a shape from the surface, at most `limit`.
  /// The bound is close to the distance if that is below `limit`.
  /// @param shape  shape in the solid's frame, metres.
  [[nodiscard]] double DistanceFrom(const ConvexShape& shape, double limit) const;

  /// Return true only if the shape is certainly farther from the surface than `distance`.
  [[nodiscard]] bool IsApart(const ConvexShape& shape, double distance) const;

  /// Return true only if a posed shape is certainly farther from the surface than `distance`.
  [[nodiscard]] bool IsApart(const PosedShape& posed, double distance) const;

  /// Return the largest distance of a vertex from a point, metres.
  [[nodiscard]] double ReachFrom(const Eigen::Vector3d& point) const;

 private:
  object::TriangleTree tree_;  ///< in metres
  Eigen::AlignedBox3d box_;    ///< in metres
};

}  // namespace regrasp::collision
