#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

namespace regrasp::object {

/// Corners of a triangle.
using Corners = std::array<Eigen::Vector3d, 3>;

/// Bounding-volume tree of triangles, for queries that prune by the boxes.
///
/// Each node is split at the median of its triangles along the longest side of the box of their
/// centres. The tree owns the triangles. Queries are const and thread-safe.
class TriangleTree {
 public:
  TriangleTree() = default;

  /// @param triangles      any number, in any order.
  /// @param leaf_capacity  maximum number of triangles of a leaf, at least 1.
  TriangleTree(std::vector<Corners> triangles, int leaf_capacity);

  /// Triangles in the order of the leaves.
  [[nodiscard]] const std::vector<Corners>& triangles() const { return triangles_; }

  /// Visit the triangles of all leaves whose boxes, and those of their ancestors, are not pruned.
  /// @param enter  function of a box; returns whether its triangles may count.
  /// @param take   function of a triangle; returns whether the visit continues.
  template <class Enter, class Take>
  void Visit(const Enter& enter, const Take& take) const {
    if (nodes_.empty()) return;
    std::array<int, kMaxDepth> open = {0};
    for (std::size_t count = 1; count > 0;) {
      const int index = open[--count];
      const Node& node = nodes_[index];
      if (!enter(node.box)) continue;
      if (node.right > 0) {
        open[count++] = node.right;
        open[count++] = index + 1;
        continue;
      }
      for (int i = node.begin; i < node.end; ++i) {
        if (!take(triangles_[i])) return;
      }
    }
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int begin = 0;  ///< index of its first triangle
    int end = 0;
    int right = 0;  ///< index of the right child, the left one is the next node; 0: leaf
  };
  /// Maximum number of open nodes. Median splits halve the number of triangles, an int.
  static constexpr std::size_t kMaxDepth = 64;

  void Build(int begin, int end);

  int leaf_capacity_ = 1;
  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace regrasp::object
