#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

namespace regrasp::object {

/// Finds which of many boxes meet one: a tree of boxes whose leaves hold several things each, by
/// their numbers only, 20 bytes a thing.
///
/// The boxes themselves are not kept: what lies in a leaf that meets the query is told, and its
/// owner knows whether it does. Queries are const and safe from several threads.
class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;

  BoxTree() = default;
  /// @param box_of  of each thing, 0 to count − 1; called while the tree is built.
  BoxTree(int count, const std::function<Box(int)>& box_of);

  /// Calls `visit` with the number of everything whose box may meet `box`, borders included: all
  /// that do, and some of their neighbours.
  template <class Visit>
  void VisitNear(const Box& box, const Visit& visit) const {
    if (!nodes_.empty()) VisitNear(0, box, visit);
  }

 private:
  /// A node's first child stands behind it.
  struct Node {
    Box box;
    std::int32_t first = 0;   ///< leaf: of its things in order_
    std::int32_t count = 0;   ///< leaf: how many; 0 elsewhere
    std::int32_t second = 0;  ///< its second child
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
