#include "planner/tree/reached_grasps.h"

#include <algorithm>

namespace regrasp::tree {

ReachedGrasps::ReachedGrasps(const criteria::ContactSet& root, const SearchSpace& space)
    : space_(space) {
  Reach(root, -1);
}

int ReachedGrasps::Find(const criteria::ContactSet& set) const {
  const auto found = numbers_.find(set);
  return found == numbers_.end() ? -1 : found->second;
}

const std::vector<int>& ReachedGrasps::OnTuple(const FaceTuple& tuple) const {
  static const std::vector<int> kNone;
  const auto found = tuples_.find(tuple);
  return found == tuples_.end() ? kNone : found->second;
}

int ReachedGrasps::Reach(const criteria::ContactSet& set, int parent,
                         std::optional<FaceAlign> align) {
  const int node = size();
  nodes_.push_back({set, parent, std::move(align)});
  numbers_.emplace(set, node);
  tuples_[TupleOf(set, space_)].push_back(node);
  return node;
}

GraspPath ReachedGrasps::PathTo(int node) const {
  GraspPath path{nodes_.front().set, {}};
  for (; nodes_[node].parent >= 0; node = nodes_[node].parent) {
    path.steps.push_back({nodes_[node].set, nodes_[node].align});
  }
  std::reverse(path.steps.begin(), path.steps.end());
  return path;
}

}  // namespace regrasp::tree
