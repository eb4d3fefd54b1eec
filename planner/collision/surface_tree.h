#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "planner/collision/convex_shape.h"
#include "planner/object/polyhedron.h"

namespace regrasp::collision {

/// Bounding-box tree over the triangles of a solid, for distances from its surface in metres.
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

  /// Return the largest distance of a vertex from a point, metres.
  [[nodiscard]] double ReachFrom(const Eigen::Vector3d& point) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int begin = 0;  ///< first of its triangles
    int end = 0;
    int right = 0;  ///< right child, the left one is the next node; 0: leaf
  };
  using Triangle = std::array<Eigen::Vector3d, 3>;

  int Build(int begin, int end);
  template <typename OnLeaf>
  void Descend(const ConvexShape& shape, const OnLeaf& on_leaf, double& within) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace regrasp::collision
