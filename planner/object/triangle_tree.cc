#include "planner/object/triangle_tree.h"

#include <algorithm>
#include <utility>

namespace regrasp::object {

namespace {

/// Return three times the centre of a triangle.
Eigen::Vector3d SumOf(const Corners& triangle) { return triangle[0] + triangle[1] + triangle[2]; }

}  // namespace

TriangleTree::TriangleTree(std::vector<Corners> triangles, int leaf_capacity)
    : leaf_capacity_(leaf_capacity), triangles_(std::move(triangles)) {
  if (!triangles_.empty()) Build(0, static_cast<int>(triangles_.size()));
}

void TriangleTree::Build(int begin, int end) {
  const std::size_t index = nodes_.size();
  Node node{{}, begin, end};
  Eigen::AlignedBox3d centres;
  for (int i = begin; i < end; ++i) {
    for (const Eigen::Vector3d& corner : triangles_[i]) node.box.extend(corner);
    centres.extend(SumOf(triangles_[i]));
  }
  nodes_.push_back(node);
  if (end - begin <= leaf_capacity_) return;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(
      triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
      [axis](const Corners& a, const Corners& b) { return SumOf(a)[axis] < SumOf(b)[axis]; });
  Build(begin, middle);
  nodes_[index].right = static_cast<int>(nodes_.size());
  Build(middle, end);
}

}  // namespace regrasp::object
