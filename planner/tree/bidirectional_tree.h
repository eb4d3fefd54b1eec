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
#include "planner/criteria/grasp_evaluator.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/face_align.h"

namespace regrasp::tree {

/// Tree of the grasps that are reachable from one grasp.
class ReachedGrasps {
 public:
  /// @param space  search space that outlives this object.
  ReachedGrasps(const criteria::ContactSet& root, const SearchSpace& space);

  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] const criteria::ContactSet& operator[](int node) const { return nodes_[node].set; }
  /// Return the node of a grasp; −1 if it has not been reached.
  [[nodiscard]] int Find(const criteria::ContactSet& set) const;
  /// Return the nodes on one tuple of faces, in the order in which they were reached.
  [[nodiscard]] const std::vector<int>& OnTuple(const FaceTuple& tuple) const;
  /// Number of reached tuples of faces.
  [[nodiscard]] int tuple_count() const { return static_cast<int>(tuples_.size()); }

  /// Add a new grasp as a child of a node.
  /// @returns its node.
  int Reach(const criteria::ContactSet& set, int parent,
            std::optional<FaceAlign> align = std::nullopt);

  /// Return the path from the root to a node.
  [[nodiscard]] GraspPath PathTo(int node) const;

 private:
  struct Node {
    criteria::ContactSet set;
    int parent;
    std::optional<FaceAlign> align;  ///< sliding step from the parent; none for a finger switch
  };

  const SearchSpace& space_;
  std::vector<Node> nodes_;
  std::unordered_map<criteria::ContactSet, int, criteria::ContactSetHash> numbers_;
  std::map<FaceTuple, std::vector<int>> tuples_;
};

/// Connect two grasps by a tree of grasps from each, grown in turn (Kuffner and LaValle 2000).
///
/// A tree grows by finger switches of each of its grasps with each candidate contact. The order is
/// fair: no grasp tests a candidate before the others have tested the earlier ones. Candidates are
/// the contacts of both grasps, then random ones of the whole surface. They are the same for both
/// trees, so that the trees meet. If that alone does not connect them soon, trees also grow by:
/// - sliding steps to random grasps of the tuples of faces that they have reached
/// - finger switches to points nearby
/// - transitions across narrow places to new tuples of faces (FindTransition)
///
/// A grasp on a tuple that the other tree has reached is connected to it by a straight sliding
/// step, if one is proved.
class BidirectionalTree {
 public:
  /// @param from, to  grasps that the space admits.
  /// @param source, random, space  sources of contacts and grasps; all arguments outlive this
  ///     object.
  BidirectionalTree(const criteria::ContactSet& from, const criteria::ContactSet& to,
                    const sampling::SurfaceSampler& source, RandomStream& random,
                    SearchSpace& space);

  /// Grow until the trees meet.
  /// @returns the path; nullopt if they have not met within the limits of the space.
  [[nodiscard]] std::optional<GraspPath> Join();

  /// Grasps and tuples of faces reached from one side: 0 start, 1 goal.
  [[nodiscard]] const ReachedGrasps& tree(int side) const { return trees_[side].reached; }

 private:
  /// Grasp that has not been tested with the candidates from `next` on.
  struct QueueEntry {
    int rank;  ///< priority; the smallest is at the top, the lowest node number first
    int node;
    int next;
    bool operator<(const QueueEntry& other) const {
      return rank != other.rank ? rank > other.rank : node > other.node;
    }
  };
  struct Tree {
    ReachedGrasps reached;
    std::priority_queue<QueueEntry> queue;
    std::vector<QueueEntry> waiting;  ///< grasps that were tested with all candidates
  };

  void GrowBySwitches(int side, std::int64_t until);
  void GrowAround(int side, std::int64_t until);
  /// Draw a grasp near one of the tree, and reach it by a sliding step or a switch of one contact.
  /// @returns whether a grasp was added or already known.
  bool AlignAround(int side, int node, double reach);
  bool SwitchAround(int side, int node, double reach);
  /// Search for transitions from random grasps of the tree to tuples of faces new to it.
  void GrowAcross(int side, std::int64_t until);
  /// Draw a face: any face of the object, or one with contacts of the other tree.
  FaceIndex FaceAcross(int side);
  /// Reach a grasp by a sliding step.
  /// @returns its node; −1 if no sliding step was proved.
  int AlignTo(int side, int node, const criteria::ContactSet& set);
  /// Reach the last of several grasps by sliding steps, through intermediate ones if necessary.
  /// @returns its node; −1 if no sliding step was proved.
  int AlignAlong(int side, int node, std::span<const grasp::Grasp> path);
  void TryCandidate(int side, int node, int candidate);
  void TryToReach(int side, const criteria::ContactSet& set, int parent);
  void Reach(int side, const criteria::ContactSet& set, int parent,
             std::optional<FaceAlign> align = std::nullopt);
  /// Queue a grasp for tests of candidates.
  void MakeQueueEntry(int side, int node);
  void Meet(int side, int node);
  struct NodeAt {
    double distance;
    int node;
    auto operator<=>(const NodeAt&) const = default;
  };
  /// Return nodes of the tree on the grasp's tuple of faces, the nearest first.
  /// @param most  largest number of nodes.
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

/// Motion of a grasp to a position at which a finger switch is possible.
struct Transition {
  /// Grasps of the first tuple of faces, each slightly different from the previous one, all
  /// admitted, with contacts in the same order. The first is the start of the search.
  std::vector<grasp::Grasp> path;
  /// Grasp after the switch from the last of them: one contact is released, another is placed.
  grasp::Grasp after;
};

/// Search for a switch of one finger between two tuples of faces that few grasps allow.
/// All contacts, including the one to be placed, move together on their faces at random. A move is
/// kept if it lowers the required friction angle of the later grasp and the earlier grasp stays
/// admitted, until the later grasp is admitted too. If a quality is required, the angle may
/// decrease below the space's friction angle.
///
/// @param before   grasp that the space admits.
/// @param leaving  index in `before` of the contact that is released.
/// @param placed   initial position of the contact that is placed.
/// @returns the transition; nullopt if the search fails, which does not prove that there is none.
[[nodiscard]] std::optional<Transition> FindTransition(const grasp::Grasp& before, int leaving,
                                                       const grasp::Contact& placed,
                                                       const sampling::SurfaceSampler& source,
                                                       RandomStream& random, SearchSpace& space);

}  // namespace regrasp::tree
