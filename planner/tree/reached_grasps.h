#pragma once

#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// A tree of the grasps that steps reach from one grasp.
class ReachedGrasps {
 public:
  /// @param space  outlives this object.
  ReachedGrasps(const criteria::ContactSet& root, const SearchSpace& space);

  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] const criteria::ContactSet& operator[](int node) const { return nodes_[node].set; }
  /// The node of a grasp; −1 where it has not been reached.
  [[nodiscard]] int Find(const criteria::ContactSet& set) const;
  /// The nodes on one tuple of faces, in the order in which they were reached.
  [[nodiscard]] const std::vector<int>& OnTuple(const FaceTuple& tuple) const;
  /// Tuples of faces reached.
  [[nodiscard]] int tuple_count() const { return static_cast<int>(tuples_.size()); }

  /// Reaches a new grasp from a node. @returns its node.
  int Reach(const criteria::ContactSet& set, int parent,
            std::optional<FaceAlign> align = std::nullopt);

  /// From the root to a node.
  [[nodiscard]] GraspPath PathTo(int node) const;

 private:
  struct Node {
    criteria::ContactSet set;
    int parent;
    std::optional<FaceAlign> align;  ///< of the step from the parent; none for a switch
  };

  const SearchSpace& space_;
  std::vector<Node> nodes_;
  std::unordered_map<criteria::ContactSet, int, criteria::ContactSetHash> numbers_;
  std::map<FaceTuple, std::vector<int>> tuples_;
};

}  // namespace regrasp::tree
