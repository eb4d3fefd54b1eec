#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
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

/// Tree of boxes that finds the boxes intersecting a query box.
///
/// A leaf holds the numbers of several items and one box around them; this takes 20 bytes per item.
/// The boxes of single items are not stored. A query therefore returns all items of each leaf that
/// it intersects, and the caller tests them. Queries are const and thread-safe.
class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;

  BoxTree() = default;
  /// @param count  number of items.
  /// @param box_of  function that returns the box of an item, 0 to count − 1; called during
  ///     construction only.
  BoxTree(int count, const std::function<Box(int)>& box_of);

  /// Call `visit` with the number of each item whose box may intersect `box`, borders included.
  ///
  /// All intersecting items are visited, and some of their neighbours.
  template <class Visit>
  void VisitNear(const Box& box, const Visit& visit) const {
    if (!nodes_.empty()) VisitNear(0, box, visit);
  }

 private:
  /// A node; its first child is the next node in `nodes_`.
  struct Node {
    Box box;
    std::int32_t first = 0;   ///< leaf: index of its first item in order_
    std::int32_t count = 0;   ///< number of items of a leaf; 0 for other nodes
    std::int32_t second = 0;  ///< index of the second child
  };

  template <class Visit>
  void VisitNear(int at, const Box& box, const Visit& visit) const {
    const Node& node = nodes_[at];
    if (!node.box.intersects(box)) return;
    if (node.count == 0) {
      VisitNear(at + 1, box, visit);
      VisitNear(node.second, box, visit);
    }
    for (std::int32_t i = 0; i < node.count; ++i) visit(order_[node.first + i]);
  }

  class Builder;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
};

}  // namespace regrasp::object
