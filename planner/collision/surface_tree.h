#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "planner/collision/convex_shape.h"
#include "planner/object/polyhedron.h"

namespace regrasp::collision {

/// The surface of a solid as a tree of boxes over its triangles, in metres: how far shapes are from
/// it. What is wholly inside the solid is far from the surface too: paths that begin outside and
/// keep off the surface stay outside.
class SurfaceTree {
 public:
  /// @param scale  metres per unit of the solid's file.
  SurfaceTree(const object::Polyhedron& solid, double scale);

  /// A certified lower bound on the distance of a shape from the surface, no more than `limit`;
  /// close to the distance where that is smaller.
  /// @param shape  in the solid's frame, metres.
  [[nodiscard]] double DistanceFrom(const ConvexShape& shape, double limit) const;

  /// True only where the shape is certainly farther from the surface than `distance`.
  [[nodiscard]] bool IsApart(const ConvexShape& shape, double distance) const;

  /// The largest distance of a vertex from a point, metres.
  [[nodiscard]] double ReachFrom(const Eigen::Vector3d& point) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int begin = 0;  ///< of its triangles
    int end = 0;
    int right = 0;  ///< of its children, the left one is the next node; 0: a leaf
  };
  using Triangle = std::array<Eigen::Vector3d, 3>;

  int Build(int begin, int end);
  template <typename OnLeaf>
  void Descend(const ConvexShape& shape, const OnLeaf& on_leaf, double& within) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace regrasp::collision
