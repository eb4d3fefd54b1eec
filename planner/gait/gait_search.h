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
#include "planner/criteria/grasp_memory.h"
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

/// How far something carried a gait out.
struct GaitExecution {
  int changes = 0;             ///< stretches that are no moves, before one failed
  bool is_held = true;         ///< before the first stretch
  bool fails_in_move = false;  ///< and in no change
  bool is_whole = false;       ///< none failed
  bool is_cut_short = false;   ///< the time was up before one failed
  plan::Reason reason = {};    ///< of what failed
};
/// How often what failed.
using FailureCounts = std::map<plan::Reason, std::int64_t>;
/// Tries a gait, or the beginning of one.
using SimulateExecution = std::function<GaitExecution(const Gait&)>;

/// Tries the ways of a tree of rests, and cuts off what is not carried out. The more steps of the
/// track are tried at once, the more often the last ones were carried out.
class EdgeSimulation {
 public:
  /// Both outlive this object.
  EdgeSimulation(const PoseGrid& grid, StanceTree& tree) : grid_(grid), tree_(tree) {}

  /// From now on ways are tried; before, all are believed.
  void TryWith(SimulateExecution carry_out) { carry_out_ = std::move(carry_out); }
  [[nodiscard]] bool are_tried() const { return carry_out_ != nullptr; }

  /// Whether the way to a rest is carried out; few steps after what was carried out are believed.
  [[nodiscard]] bool ExecutesInSimulation(int rest);
  /// @param gait  the way to a rest, perhaps on to where it brings the object.
  /// @returns whether all of it is carried out; else what failed is cut off.
  [[nodiscard]] bool Try(int rest, const Gait& gait);
  /// Whether a change from a rest at a node to a grasp was tried in vain.
  [[nodiscard]] bool HasFailed(int rest, int node, const ContactAssignment& to) const {
    return failed_.contains({rest, node, to});
  }

  /// A step: a way was carried out so far, and what is believed goes no farther.
  [[nodiscard]] int MayReach() const {
    return are_tried() ? farthest_ + at_once_ : std::numeric_limits<int>::max();
  }
  [[nodiscard]] const FailureCounts& in_vain() const { return in_vain_; }  ///< ways

 private:
  static constexpr int kFewestAtOnce = 12;  ///< steps of the track, some 40 degrees
  static constexpr int kMostAtOnce = 96;
  /// A grasp from which so many changes failed is no good one to change from.
  static constexpr int kMostFailedChanges = 3;
  struct FailedChanges {
    int count = 0;
    int first_step = std::numeric_limits<int>::max();
  };

  /// The object is not carried with a rest to a step, and perhaps not half as far.
  void LimitToMiddle(int rest, int step);
  void CountFailedChange(int rest, int step);
  void MarkExecutedUpTo(int rest);

  const PoseGrid& grid_;
  StanceTree& tree_;
  SimulateExecution carry_out_;
  int at_once_ = kFewestAtOnce;
  int farthest_ = 0;
  FailureCounts in_vain_;
  std::set<std::tuple<int, int, ContactAssignment>> failed_;  ///< rest, node and grasp
  std::map<int, FailedChanges> failed_changes_;               ///< by rest
};

/// What a search did, and what stopped it.
struct GaitCounts {
  std::int64_t grasps = 0;    ///< rests that were looked at
  std::int64_t expanded = 0;  ///< from which fingers were switched
  PathFailureCounts ways;
  std::int64_t colliding = 0;  ///< grasps in which fingers hit each other
  std::int64_t rolled = 0;     ///< that are lost where contacts roll, with reserve
  FailureCounts not_carried;   ///< to which the way was tried in vain
  std::int64_t at_goal = 0;    ///< with which the object comes to its goal, if there is a way
  /// Steps of the track: the farthest that was reached, or carried out where ways are tried.
  int farthest = 0;
  int steps = 0;  ///< that it has

  /// Adds those of a search from another end; what was reached stays.
  void Add(const GaitCounts& other);
};

/// Searches a gait that takes an object from the start of a grid of poses to its goal: rests are
/// grasps of three or more fingers; from each the object goes as far as these can follow, somewhere
/// on that path a free finger is placed and another one lifted, or one that holds slides.
///
/// Best first: rests from which the object gets farthest, and from which each single finger could
/// go on farther, come first; those nearer to the goal grasp before others. The more of them were
/// expanded that end at one step, or are much alike, the later others come like these, so that a
/// dead end does not hold the search up. What is costly, paths of fingers and ways round on the
/// grid, is worked out when a rest's turn comes; certificates of moves when a gait is complete.
class GaitSearch {
 public:
  /// @param carrier  on the grid.
  /// @param memory   knows the setup's points as contacts under their numbers. All outlive this
  ///                 object.
  GaitSearch(const HandSetup& setup, const PoseGrid& grid, ObjectMotionChecker& checker,
             const GaitEnds& ends, criteria::GraspMemory& memory, RandomStream& random);

  /// From now on ways are tried before much grows from them, and gaits are carried out as a whole.
  /// Before the first Run.
  void SimulateEdges(SimulateExecution carry_out) { simulation_.TryWith(std::move(carry_out)); }

  /// Whether some fingers can hold the goal grasp, if there is one, at the goal pose.
  [[nodiscard]] bool GoalIsHeld() const { return goal_.IsWithinReach(); }

  /// Goes on until so many rests were expanded in all calls together.
  /// @returns nullopt where none was found until then, or until the deadline.
  [[nodiscard]] std::optional<Gait> Run(std::int64_t most_expanded, const Deadline& deadline);
  /// Whether nothing is left to expand.
  [[nodiscard]] bool IsExhausted() const { return begun_ && queue_.empty(); }

  [[nodiscard]] GaitCounts counts() const;

  // For a search that goes the other way.

  /// Begins with a hold at the start of the grid, instead of others.
  void StartFrom(const Stance& hold);
  /// The first rest of the way to a rest.
  [[nodiscard]] int RootOf(int rest) const { return tree_.RootOf(rest); }
  /// The rest that was expanded last, by number; −1 before.
  [[nodiscard]] int last_expanded() const { return last_expanded_; }
  [[nodiscard]] const Stance& StanceOf(int rest) const { return tree_[rest].hold; }
  /// The nodes to which an expanded rest is carried; others where PathTo had to go round something.
  [[nodiscard]] const std::map<int, int>& NodesOf(int rest) const {
    return tree_[rest].carried.from;
  }
  /// Whether it turned out that the object can't be brought to a rest.
  [[nodiscard]] bool IsCutOff(int rest) const { return tree_[rest].is_cut_off; }
  /// The whole way with a rest to one of its nodes, where it is free.
  [[nodiscard]] std::optional<Gait> PathTo(int rest, int node) { return tree_.PathTo(rest, node); }
  /// As StanceTree::WithIdlePosture.
  [[nodiscard]] int WithIdlePosture(int rest, FingerIndex finger, const Posture& posture) {
    return tree_.WithIdlePosture(rest, finger, posture);
  }
  /// Finds more nodes to which an expanded rest is carried.
  void CarryAround(int rest) { tree_.ExtendReachable(tree_[rest]); }
  /// From now on grasps near to this one are looked at before others, too.
  void AddTarget(const ContactAssignment& holding);

 private:
  /// The last node on a way at which tips that roll hold, and where they are there.
  struct RolledTo {
    int node = 0;
    RolledTips tips;
  };
  struct QueueEntry {
    double score;
    int rest;
    bool operator<(const QueueEntry& other) const {
      return score != other.score ? score < other.score : rest > other.rest;
    }
  };
  /// Of a grasp that was taken up at a node; no rest: it could not be.
  struct QueuedGrasp {
    int node;
    int rest = -1;
  };

  /// The step that counts as reached: of ways that are tried none beyond what is carried out and
  /// believed.
  [[nodiscard]] int farthest() const { return std::min(reached_, simulation_.MayReach()); }
  void AddInitialStances();
  void AddGivenStart();
  void Expand(int index);
  /// @returns whether rests are taken up.
  bool SwitchAt(int index, int node);
  /// How good a grasp is that a change leads to; nullopt where it is none.
  [[nodiscard]] std::optional<double> ScoreAfter(const StanceNode& from,
                                                 const ContactAssignment& to, int node);
  /// Whether a grasp was taken up at a node, and is not cut off.
  [[nodiscard]] bool IsTaken(const ContactAssignment& holding, int node) const;
  /// Takes a rest up if it is admitted, new, and its fingers have places to be. @returns whether.
  bool Add(StanceNode rest);
  [[nodiscard]] bool IsGrasp(const ContactAssignment& holding);
  /// Where tips roll to when the object is carried towards a node; without reserve it comes there.
  [[nodiscard]] RolledTo RollTowards(const StanceNode& rest, int node);
  /// Of a new rest, from `rolled_before`. @returns whether its tips hold there.
  [[nodiscard]] bool TakeRolledTips(StanceNode& rest);
  [[nodiscard]] bool WasExpandedAt(const StanceNode& rest) const;
  [[nodiscard]] double ScoreOf(const ContactAssignment& holding, int node, int slides, int last);
  /// Whether there is a way to a rest and on with it; `carried.end` is where it leads to, which
  /// may be nearer than before.
  [[nodiscard]] bool ReachesEnd(int index);
  /// Works out the way to a new rest. @returns the rest as it is come to; −1 where it is not.
  [[nodiscard]] int ConnectToParent(int index);
  /// The next rest in turn.
  [[nodiscard]] int PopNext();
  [[nodiscard]] std::optional<Gait> GaitFrom(int index);

  const HandSetup& setup_;
  const PoseGrid& grid_;
  std::vector<int> start_;  ///< the grasp to begin with; none: any
  std::vector<FingerIndex> start_fingers_;
  GoalGrasp goal_;
  int most_holding_;
  criteria::GraspMemory& memory_;
  RandomStream& random_;
  ObjectMotionChecker& checker_;
  SlideRoutes routes_;
  SuccessorGenerator next_;
  ContactClusters clusters_;
  NoveltyPenalty novelty_;
  RollingTips rolling_;
  StanceTree tree_;
  EdgeSimulation simulation_;
  std::priority_queue<QueueEntry> queue_;
  /// Where each grasp was taken up, or could not be.
  std::map<ContactAssignment, std::vector<QueuedGrasp>> taken_;
  std::map<ContactAssignment, int> failed_;  ///< times that a grasp was not come to
  /// Of each grasp the rests that were expanded.
  std::map<ContactAssignment, std::vector<int>> expanded_;
  GaitCounts counts_;
  int reached_ = 0;  ///< the farthest step
  int last_expanded_ = -1;
  std::set<ContactAssignment> targets_;  ///< kinds of them
  bool begun_ = false;
};

}  // namespace regrasp::gait
