#include "planner/object/box_tree.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace regrasp::object {

namespace {

/// Maximum number of items per leaf. Fewer need more memory; more cause unnecessary visits.
constexpr std::ptrdiff_t kLeaf = 6;

}  // namespace

class BoxTree::Builder {
 public:
  Builder(BoxTree& tree, const std::function<Box(int)>& box_of) : tree_(tree), box_of_(box_of) {
    centres_.reserve(tree.order_.size());
    for (const int i : tree.order_) centres_.push_back(box_of(i).center());
    tree.nodes_.reserve(NodesOver(tree.order_.size()));
  }

  /// Build the subtree of some items. @returns index of its root.
  int Build(std::span<std::int32_t> things) {
    const int at = static_cast<int>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    if (std::ssize(things) <= kLeaf) {
      Node& leaf = tree_.nodes_[at];
      for (const int i : things) leaf.box.extend(box_of_(i));
      leaf.first = static_cast<std::int32_t>(things.data() - tree_.order_.data());
      leaf.count = static_cast<std::int32_t>(things.size());
      return at;
    }
    const std::size_t half = things.size() / 2;
    SortHalves(things, half);
    const int first = Build(things.first(half)), second = Build(things.subspan(half));
    Node& node = tree_.nodes_[at];
    node.box = tree_.nodes_[first].box.merged(tree_.nodes_[second].box);
    node.second = second;
    return at;
  }

 private:
  /// Return the number of nodes of a tree with this many items.
  static std::size_t NodesOver(std::size_t things) {
    if (things <= std::size_t{kLeaf}) return 1;
    return 1 + NodesOver(things / 2) + NodesOver(things - things / 2);
  }

  /// Split items at the median along the direction in which their centres differ most.
  void SortHalves(std::span<std::int32_t> things, std::size_t half) const {
    Box centres;
    for (const int i : things) centres.extend(centres_[i]);
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    std::ranges::nth_element(things, things.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [&](int i) { return std::pair(centres_[i][axis], i); });
  }

  BoxTree& tree_;
  const std::function<Box(int)>& box_of_;
  std::vector<Eigen::Vector3d> centres_;
};

BoxTree::BoxTree(int count, const std::function<Box(int)>& box_of) : order_(count) {
  if (count == 0) return;
  std::iota(order_.begin(), order_.end(), 0);
  Builder(*this, box_of).Build(order_);
}

}  // namespace regrasp::object
