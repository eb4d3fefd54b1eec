#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/face_align.h"
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

/// Joins two grasps by a tree of grasps from each, grown in turn (Kuffner and LaValle 2000).
///
/// A tree grows by finger switches, every one of its grasps with every candidate contact, fair to
/// all: no grasp sees a candidate before the others have seen those before it. Candidates are the
/// contacts of both grasps, then random ones of the whole surface, the same for both trees, so that
/// the trees meet. Where that alone has not joined them soon, trees also grow by aligns to random
/// grasps of the tuples of faces that they have reached, by switches to points nearby, and across
/// narrow places to new tuples of faces (FindTransition). A grasp whose tuple the other tree knows
/// is joined to it by a straight align where one is proved.
class BidirectionalTree {
 public:
  /// @param from, to  grasps that the space admits, as do all that follow. All outlive this object.
  BidirectionalTree(const criteria::ContactSet& from, const criteria::ContactSet& to,
                    const sampling::SurfaceSampler& source, RandomStream& random,
                    SearchSpace& space);

  /// Grows until the trees meet.
  /// @returns nullopt where they have not met within the limits of the space.
  [[nodiscard]] std::optional<GraspPath> Join();

  /// Grasps and tuples of faces reached from either side.
  [[nodiscard]] const ReachedGrasps& tree(int side) const { return trees_[side].reached; }

 private:
  /// A grasp that candidates from `next` on have not been tried on.
  struct QueueEntry {
    int rank;  ///< of equal ones the first; the queue's top is its largest
    int node;
    int next;
    bool operator<(const QueueEntry& other) const {
      return rank != other.rank ? rank > other.rank : node > other.node;
    }
  };
  struct Tree {
    ReachedGrasps reached;
    std::priority_queue<QueueEntry> queue;
    std::vector<QueueEntry> waiting;  ///< grasps that have seen all candidates
  };

  void GrowBySwitches(int side, std::int64_t until);
  void GrowAround(int side, std::int64_t until);
  /// Draw a grasp around one of the tree and reach it, if it is one, by an align or by a switch of
  /// one contact. @returns whether it came to something.
  bool AlignAround(int side, int node, double reach);
  bool SwitchAround(int side, int node, double reach);
  /// Looks for transitions from random grasps of the tree to tuples of faces new to it.
  void GrowAcross(int side, std::int64_t until);
  /// Any face of the body, or one that the other tree's grasps are on.
  FaceIndex FaceAcross(int side);
  /// Reaches a grasp by an align, whose node is returned; −1 where none was proved.
  int AlignTo(int side, int node, const criteria::ContactSet& set);
  /// The same for the last of several grasps, over some of the others where it has to be.
  int AlignAlong(int side, int node, std::span<const grasp::Grasp> path);
  void TryCandidate(int side, int node, int candidate);
  void TryToReach(int side, const criteria::ContactSet& set, int parent);
  void Reach(int side, const criteria::ContactSet& set, int parent,
             std::optional<FaceAlign> align = std::nullopt);
  /// Lets candidates be tried on a grasp.
  void MakeQueueEntry(int side, int node);
  void Meet(int side, int node);
  struct NodeAt {
    double distance;
    int node;
    auto operator<=>(const NodeAt&) const = default;
  };
  /// Nodes of the tuple in a tree, those nearest to the grasp first.
  [[nodiscard]] std::vector<NodeAt> NearestOnTuple(int side, const criteria::ContactSet& set,
                                                   int most) const;
  void AddCandidates();

  const sampling::SurfaceSampler& source_;
  RandomStream& random_;
  SearchSpace& space_;
  std::array<Tree, 2> trees_;
  std::vector<int> candidates_;
  std::optional<GraspPath> found_;
};

}  // namespace regrasp::tree
