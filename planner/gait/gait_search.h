#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/change_paths.h"
#include "planner/gait/finger_path.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/rolling.h"
#include "planner/gait/stance_tree.h"
#include "planner/gait/successors.h"
#include "planner/plan/reason.h"

namespace regrasp::gait {

/// Result of the simulated execution of a gait.
struct GaitExecution {
  int changes = 0;             ///< contact changes completed before the failure
  bool is_held = true;         ///< the initial grasp holds the object
  bool fails_in_move = false;  ///< the failure occurs in an in-hand motion
  bool is_whole = false;       ///< whether all segments execute
  bool is_cut_short = false;   ///< the time limit was reached before a failure
  plan::Reason reason = {};    ///< reason of the failure
};
/// Number of failures per reason.
using FailureCounts = std::map<plan::Reason, std::int64_t>;
/// Simulates the execution of a gait or of its beginning.
using SimulateExecution = std::function<GaitExecution(const Gait&)>;

/// Lazy evaluation of the edges of a stance tree by simulated execution.
/// Prunes subtrees whose path fails. The number of track steps that may remain unsimulated doubles
/// after a success and halves after a failure.
class EdgeSimulation {
 public:
  /// Both arguments outlive this object.
  EdgeSimulation(const PoseGrid& grid, StanceTree& tree) : grid_(grid), tree_(tree) {}

  /// Enable the simulation. Before, every path is trusted.
  void SimulateWith(SimulateExecution simulate) { simulate_ = std::move(simulate); }
  [[nodiscard]] bool is_enabled() const { return simulate_ != nullptr; }

  /// Return whether the path to a stance executes.
  /// A path that extends the confirmed one by less than the look-ahead is trusted.
  [[nodiscard]] bool ExecutesInSimulation(int index);
  /// Simulate a gait; prune the tree at the first failure.
  /// @param gait  path to the stance, optionally extended to a reachable grid node.
  /// @returns whether the whole gait executes.
  [[nodiscard]] bool Simulate(int index, const Gait& gait);
  /// Return whether the change from a stance at a node to an assignment failed in simulation.
  [[nodiscard]] bool HasFailed(int index, int node, const ContactAssignment& to) const {
    return failed_.contains({index, node, to});
  }

  /// Farthest track step that is confirmed by simulation, plus the look-ahead.
  [[nodiscard]] int FarthestTrusted() const {
    return is_enabled() ? farthest_ + lookahead_ : std::numeric_limits<int>::max();
  }
  /// Failed simulations by reason.
  [[nodiscard]] const FailureCounts& failures() const { return failures_; }

 private:
  static constexpr int kLeastLookahead = 12;  ///< track steps, about 40 degrees
  static constexpr int kGreatestLookahead = 96;
  /// Failed changes from one stance after which the stance is limited to earlier steps.
  static constexpr int kMaxFailedChanges = 3;
  struct FailedChanges {
    int count = 0;
    int first_step = std::numeric_limits<int>::max();
  };

  /// Limit the in-hand motions of a stance to half the distance to a step that failed.
  void LimitToMiddle(int index, int step);
  void CountFailedChange(int index, int step);
  void MarkExecutedUpTo(int index);

  const PoseGrid& grid_;
  StanceTree& tree_;
  SimulateExecution simulate_;
  int lookahead_ = kLeastLookahead;
  int farthest_ = 0;
  FailureCounts failures_;
  std::set<std::tuple<int, int, ContactAssignment>> failed_;  ///< stance, grid node and assignment
  std::map<int, FailedChanges> failed_changes_;               ///< rejected changes, by stance
};

/// Statistics of a search, for messages and for the selection between searches.
struct GaitCounts {
  std::int64_t evaluated = 0;              ///< number of evaluated stances
  std::vector<std::int64_t> holding = {};  ///< evaluated stances that each finger holds [finger]
  std::int64_t expanded = 0;               ///< number of expanded stances
  PathFailureCounts path_failures;
  std::int64_t colliding = 0;        ///< stances rejected because fingers collide
  std::int64_t rolled = 0;           ///< stances rejected because the grasp is lost after rolling
  FailureCounts execution_failures;  ///< failed simulations by reason
  std::int64_t at_goal = 0;          ///< stances that reach the goal, before their path is planned
  /// Farthest reached track step.
  /// If edges are simulated, clamped to the confirmed steps plus the look-ahead.
  int farthest = 0;
  int steps = 0;  ///< number of track steps

  /// Return the fraction of the track that was reached, in [0, 1].
  [[nodiscard]] double fraction() const {
    return steps == 0 ? 1 : static_cast<double>(farthest) / steps;
  }
  /// Count the fingers of one evaluated stance.
  void CountHolding(const ContactAssignment& assignment);
  /// Add the counts of a search from the other end; `farthest` and `steps` keep their values.
  void Add(const GaitCounts& other);
};

/// Best-first search of a gait from the start of a pose grid to its goal.
/// A node is a StanceNode: a contact assignment of three or more fingers, entered at one grid node.
/// From there the object moves to every grid node that all holding fingers can follow. At some of
/// these grid nodes a successor is generated: an idle finger is placed, a holding finger is
/// released, or holding fingers slide.
/// The priority is the track step that the stance reaches, plus a fraction of the steps that each
/// finger alone could follow, minus penalties. There are penalties for offsets from the track,
/// distance from the goal grasp, sliding steps, repeated expansion and similarity to expanded
/// stances (NoveltyPenalty). The priority is an estimate of progress, not a path cost.
/// Evaluation is lazy: finger paths and detours on the grid are planned when a node is popped from
/// the queue, certificates of in-hand motions when a gait is complete.
class GaitSearch {
 public:
  /// @param setup  hand and contacts.
  /// @param grid  poses of the object, from start to goal.
  /// @param checker  motion checker on the same grid.
  /// @param ends  grasps at both ends; empty grasps are unconstrained.
  /// @param memory  contacts of the setup under the same numbers. All references outlive this
  ///     object.
  GaitSearch(const HandSetup& setup, const PoseGrid& grid, ObjectMotionChecker& checker,
             const GaitEnds& ends, criteria::GraspMemory& memory, RandomStream& random);

  /// Enable simulated execution of edges and of complete gaits. Call it before the first Run.
  void SimulateEdges(SimulateExecution simulate) { simulation_.SimulateWith(std::move(simulate)); }

  /// Return whether some fingers can hold the goal grasp, if any, at the goal pose.
  [[nodiscard]] bool GoalIsHeld() const { return goal_.IsReachable(); }

  /// Continue the search until the total number of expansions reaches a limit.
  /// @param most_expanded  maximum number of expanded stances over all calls.
  /// @returns the gait; nullopt if the limit or the deadline is reached, or the queue is empty.
  [[nodiscard]] std::optional<Gait> Run(std::int64_t most_expanded, const Deadline& deadline);
  /// Return whether the queue is empty.
  [[nodiscard]] bool IsExhausted() const { return is_started_ && queue_.empty(); }

  [[nodiscard]] GaitCounts counts() const;

  // Interface of searches from the opposite end.

  /// Start from one stance at the start of the grid instead of the initial stances.
  void StartFrom(const Stance& stance);
  /// Return the root of a stance.
  [[nodiscard]] int RootOf(int index) const { return tree_.RootOf(index); }
  /// Index of the last expanded stance; −1 if none.
  [[nodiscard]] int last_expanded() const { return last_expanded_; }
  [[nodiscard]] const Stance& StanceOf(int index) const { return tree_[index].stance; }
  /// Grid nodes that an expanded stance reaches, with predecessors.
  /// PathTo may change them when it plans a detour.
  [[nodiscard]] const std::map<int, int>& NodesOf(int index) const {
    return tree_[index].reachable.predecessor;
  }
  /// Return whether a stance is known to be unreachable.
  [[nodiscard]] bool IsPruned(int index) const { return tree_[index].is_pruned; }
  /// Plan the path to a stance and on to one of its grid nodes; nullopt if it fails.
  [[nodiscard]] std::optional<Gait> PathTo(int index, int node) {
    return tree_.PathTo(index, node);
  }
  /// Same as StanceTree::WithIdleConfiguration.
  [[nodiscard]] int WithIdleConfiguration(int index, FingerIndex finger,
                                          const JointConfiguration& configuration) {
    return tree_.WithIdleConfiguration(index, finger, configuration);
  }
  /// Search more grid nodes that an expanded stance reaches.
  void ExtendReachable(int index) { tree_.ExtendReachable(tree_[index]); }
  /// Prefer stances near this assignment in future expansions, too.
  void AddTarget(const ContactAssignment& assignment);

 private:
  /// Last grid node at which the rolled grasp is valid, with the fingertips there.
  struct RolledTo {
    int node = 0;
    RolledTips tips;
  };
  struct QueueEntry {
    double score;
    int index;
    bool operator<(const QueueEntry& other) const {
      return score != other.score ? score < other.score : index > other.index;
    }
  };
  /// A grasp queued at a grid node; `index` is -1 if it was rejected.
  struct QueuedGrasp {
    int node;
    int index = -1;
  };

  /// Farthest track step considered reached.
  /// If edges are simulated, clamped to the confirmed steps plus the look-ahead.
  [[nodiscard]] int farthest() const { return std::min(reached_, simulation_.FarthestTrusted()); }
  void AddInitialStances();
  void AddGivenStart();
  /// Give a stance at the start the required joint configurations, if there are any.
  void UseStartConfigurations(Stance& stance);
  void Expand(int index);
  /// Queue the best successors of a stance at one grid node.
  /// @returns whether any was queued.
  bool ExpandAt(int index, int node);
  /// Return the priority of a successor; nullopt if it is not an admissible grasp.
  [[nodiscard]] std::optional<double> ScoreAfter(const StanceNode& from,
                                                 const ContactAssignment& to, int node);
  /// Return whether an assignment is queued at a grid node and not pruned.
  [[nodiscard]] bool IsQueued(const ContactAssignment& assignment, int node) const;
  /// Evaluate and queue a stance if it is admissible, new and collision-free.
  /// @returns whether it was queued.
  bool Add(StanceNode stance_node);
  [[nodiscard]] bool IsGrasp(const ContactAssignment& assignment, int node);
  /// Roll the fingertips while the object moves towards a grid node.
  /// Without rolling, return the grid node itself.
  [[nodiscard]] RolledTo RollTowards(const StanceNode& stance_node, int node);
  /// Initialize the rolled fingertips of a new stance from `rolled_before`.
  /// @returns whether the grasp is valid there.
  [[nodiscard]] bool InitRolledTips(StanceNode& stance_node);
  [[nodiscard]] bool WasExpandedAt(const StanceNode& stance_node) const;
  [[nodiscard]] double ScoreOf(const ContactAssignment& assignment, int node, int slides, int last);
  /// Plan the path to a stance and on to `reachable.end`.
  /// If a motion fails, `reachable.end` moves to its predecessor.
  /// @returns whether such a path exists.
  [[nodiscard]] bool ReachesEnd(int index);
  /// Plan the edge from the parent to a new stance.
  /// @returns index of the connected stance, possibly a new one; −1 if there is no path.
  [[nodiscard]] int ConnectToParent(int index);
  /// Pop the stance with the highest current priority.
  [[nodiscard]] int PopNext();
  [[nodiscard]] std::optional<Gait> GaitFrom(int index);

  const HandSetup& setup_;
  const PoseGrid& grid_;
  std::vector<int> start_;  ///< contacts of the start grasp; empty: any
  std::vector<FingerIndex> start_fingers_;
  std::vector<JointConfiguration> start_configurations_;  ///< [finger]; empty: any
  GoalGrasp goal_;
  int max_holding_;
  criteria::GraspMemory& memory_;
  RandomStream& random_;
  ObjectMotionChecker& checker_;
  SupportedGrasps supported_;
  SlideRoutes routes_;
  SuccessorGenerator successors_;
  ContactClusters clusters_;
  NoveltyPenalty novelty_;
  RollingTips rolling_;
  StanceTree tree_;
  EdgeSimulation simulation_;
  std::priority_queue<QueueEntry> queue_;
  /// Grid nodes at which each assignment was queued or rejected.
  std::map<ContactAssignment, std::vector<QueuedGrasp>> queued_;
  std::map<ContactAssignment, int> failed_;  ///< failed connections by assignment
  /// Expanded stances by assignment.
  std::map<ContactAssignment, std::vector<int>> expanded_;
  GaitCounts counts_;
  int reached_ = 0;  ///< farthest reached step
  int last_expanded_ = -1;
  std::set<ContactAssignment> targets_;  ///< clusters of the added targets
  bool is_started_ = false;
};

}  // namespace regrasp::gait
