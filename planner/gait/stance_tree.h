#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/change_paths.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/rolling.h"

namespace regrasp::gait {

/// Node of the stance tree: a stance entered at one grid node, and the grid nodes that it reaches.
struct StanceNode {
  Stance stance;
  int node = 0;                    ///< grid node at which the stance is entered
  ReachablePoses reachable = {};   ///< grid nodes that the object reaches with the stance
  std::set<int> expanded_at = {};  ///< grid nodes at which successors were generated
  int expansions = 0;              ///< number of expansions
  double score = 0;
  int parent = -1;
  bool is_executed = false;       ///< the path to the stance executes in simulation
  bool goal_path_failed = false;  ///< the path from the stance to the goal fails in simulation
  /// Farthest track step of in-hand motions with the stance; limited by failed simulations.
  int farthest = std::numeric_limits<int>::max();
  int slides = 0;  ///< number of sliding steps from the root
  /// Edge from the parent: segments of the contact change.
  /// Planned when the node is popped from the queue.
  std::vector<PlanSegment> edge = {};
  bool is_pruned = false;  ///< the stance is known to be unreachable
  /// Planned in-hand motions by edge of the grid; empty if infeasible.
  std::map<std::pair<int, int>, std::vector<Keyframe>> moves = {};
  GridEdges blocked = {};  ///< infeasible edges of the grid
  Keyframe at = {};        ///< keyframe at `node`
  /// Rolled fingertips at `node` before and after the contact change; empty if rolling is not
  /// modelled.
  RolledTips rolled_before = {}, rolled = {};
};

/// Number of path planning failures by cause.
struct PathFailureCounts {
  std::int64_t no_path = 0;  ///< contact changes without a free finger path
  std::int64_t no_slide =
      0;  ///< sliding steps that a finger cannot follow, or that lose force closure
  std::int64_t no_move = 0;  ///< infeasible or colliding in-hand motions
};

/// Search tree of stances with lazily planned paths.
/// An edge is a contact change at a grid node of the parent. Edges and in-hand motions are planned
/// on demand because they are expensive.
class StanceTree {
 public:
  /// @param is_enough  predicate of a grid node and an assignment that ends the extension of a
  ///     stance.
  /// @param has_given_start  whether roots are given by their contacts only, so that idle fingers
  ///     may start anywhere. All other arguments outlive this object.
  StanceTree(const HandSetup& setup, const PoseGrid& grid, ObjectMotionChecker& checker,
             criteria::GraspMemory& memory, SlideRoutes& routes, RandomStream& random,
             std::function<bool(int, const ContactAssignment&)> is_enough, bool has_given_start)
      : setup_(setup),
        checker_(checker),
        paths_(setup, memory, checker, routes, random),
        is_enough_(std::move(is_enough)),
        has_given_start_(has_given_start),
        grid_(grid) {}

  /// Add a node. References to nodes stay valid.
  /// @returns index of the node.
  int Add(StanceNode stance_node);
  [[nodiscard]] StanceNode& operator[](int index) { return nodes_[index]; }
  [[nodiscard]] const StanceNode& operator[](int index) const { return nodes_[index]; }
  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] const PathFailureCounts& counts() const { return counts_; }

  /// Return the root of a node.
  [[nodiscard]] int RootOf(int index) const;
  /// Return a child of node `from` after a contact change at a grid node.
  /// It is not added to the tree.
  [[nodiscard]] StanceNode After(int from, const ContactAssignment& to, int node) const;

  /// Return the last node on the path to `index` that executes in simulation; −1 if none.
  [[nodiscard]] int LastExecuted(int index) const;
  /// Mark the path to a node as executed in simulation.
  void MarkExecuted(int index);
  /// Prune the path to a node after a number of contact changes.
  /// Prunes the first later node on the path; −1 prunes the root.
  /// @returns the pruned node; −1 if the path has no more changes.
  int PruneAfter(int index, int changes);
  /// Limit the in-hand motions of a node to a track step, and prune the children beyond it.
  void LimitBefore(int index, int step);

  /// Search the grid nodes that a stance reaches without infeasible motions.
  void ExtendReachable(StanceNode& stance_node);
  /// Plan the contact change from the parent to a node.
  /// @returns whether it succeeds.
  [[nodiscard]] bool PlanPathFromParent(StanceNode& stance_node);
  /// Plan the whole path to a node and on to one of its grid nodes.
  /// A node that proves unreachable is pruned with its subtree.
  /// @returns the gait; nullopt if a motion fails.
  [[nodiscard]] std::optional<Gait> PathTo(int index, int node);

  /// Copy the path to a node with another idle configuration of one finger.
  /// The configuration applies since the finger's last contact or, with a given start, since the
  /// root.
  /// @returns index of the copied node; −1 if a collision occurs or the root fixes the
  ///     configuration.
  [[nodiscard]] int WithIdleConfiguration(int index, FingerIndex finger,
                                          const JointConfiguration& configuration);
  /// Connect a node whose placed finger has no path.
  /// Lets the finger idle above its future contact beforehand (WithIdleConfiguration).
  /// @returns index of the connected copy; −1 if it fails.
  [[nodiscard]] int AfterIdlingAbove(int index);

 private:
  /// Return the in-hand motion between adjacent grid nodes; null if infeasible.
  [[nodiscard]] const std::vector<Keyframe>* MoveBetween(StanceNode& stance_node, int from, int to);
  /// Plan the in-hand motion to a reachable grid node.
  /// Plans detours around infeasible edges; nullopt if there is none.
  [[nodiscard]] std::optional<std::vector<Keyframe>> MoveFrom(StanceNode& stance_node, int node);
  void Prune(int index);
  /// Reset the idle configurations before and after the change to those of the parent.
  /// Applies to fingers that idle both before and after. They may differ if a released finger found
  /// no path to its idle configuration.
  void IdleAsBefore(StanceNode& stance_node) const;

  const HandSetup& setup_;
  ObjectMotionChecker& checker_;
  ChangePaths paths_;
  std::function<bool(int, const ContactAssignment&)> is_enough_;
  bool has_given_start_;
  const PoseGrid& grid_;
  std::deque<StanceNode> nodes_;  ///< addresses are stable
  PathFailureCounts counts_;
};

}  // namespace regrasp::gait
