#pragma once

#include <map>
#include <optional>
#include <queue>
#include <set>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/carrier.h"
#include "planner/gait/contact_kinds.h"
#include "planner/gait/crowding.h"
#include "planner/gait/finger_path.h"
#include "planner/gait/gait.h"
#include "planner/gait/goal_grasp.h"
#include "planner/gait/hand_setup.h"
#include "planner/gait/next_holdings.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/rest_tree.h"
#include "planner/gait/rolling.h"
#include "planner/gait/slide_path.h"
#include "planner/gait/tried_ways.h"

namespace regrasp::gait {

/// What a search did, and what stopped it.
struct GaitCounts {
  std::int64_t grasps = 0;    ///< rests that were looked at
  std::int64_t expanded = 0;  ///< from which fingers were switched
  WayCounts ways;
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
  GaitSearch(const HandSetup& setup, const PoseGrid& grid, Carrier& carrier, const GaitEnds& ends,
             criteria::GraspMemory& memory, RandomStream& random);

  /// From now on ways are tried before much grows from them, and gaits are carried out as a whole.
  /// Before the first Run.
  void TryWays(CarryOut carry_out) { tried_.TryWith(std::move(carry_out)); }

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
  void BeginWith(const Hold& hold);
  /// The first rest of the way to a rest.
  [[nodiscard]] int RootOf(int rest) const { return tree_.RootOf(rest); }
  /// The rest that was expanded last, by number; −1 before.
  [[nodiscard]] int last_expanded() const { return last_expanded_; }
  [[nodiscard]] const Hold& HoldOf(int rest) const { return tree_[rest].hold; }
  /// The nodes to which an expanded rest is carried; others where WayTo had to go round something.
  [[nodiscard]] const std::map<int, int>& NodesOf(int rest) const {
    return tree_[rest].carried.from;
  }
  /// Whether it turned out that the object can't be brought to a rest.
  [[nodiscard]] bool IsCutOff(int rest) const { return tree_[rest].is_cut_off; }
  /// The whole way with a rest to one of its nodes, where it is free.
  [[nodiscard]] std::optional<Gait> WayTo(int rest, int node) { return tree_.WayTo(rest, node); }
  /// As RestTree::WithWaiting.
  [[nodiscard]] int WithWaiting(int rest, FingerIndex finger, const Posture& posture) {
    return tree_.WithWaiting(rest, finger, posture);
  }
  /// Finds more nodes to which an expanded rest is carried.
  void CarryAround(int rest) { tree_.CarryOn(tree_[rest]); }
  /// From now on grasps near to this one are looked at before others, too.
  void AddTarget(const Holding& holding);

 private:
  /// The last node on a way at which tips that roll hold, and where they are there.
  struct RolledTo {
    int node = 0;
    RolledTips tips;
  };
  struct Waiting {
    double score;
    int rest;
    bool operator<(const Waiting& other) const {
      return score != other.score ? score < other.score : rest > other.rest;
    }
  };
  /// Of a grasp that was taken up at a node; no rest: it could not be.
  struct Taken {
    int node;
    int rest = -1;
  };

  /// The step that counts as reached: of ways that are tried none beyond what is carried out and
  /// believed.
  [[nodiscard]] int farthest() const { return std::min(reached_, tried_.MayReach()); }
  void AddFirstRests();
  void AddGivenStart();
  void Expand(int index);
  /// @returns whether rests are taken up.
  bool SwitchAt(int index, int node);
  /// How good a grasp is that a change leads to; nullopt where it is none.
  [[nodiscard]] std::optional<double> ScoreAfter(const Rest& from, const Holding& to, int node);
  /// Whether a grasp was taken up at a node, and is not cut off.
  [[nodiscard]] bool IsTaken(const Holding& holding, int node) const;
  /// Takes a rest up if it is admitted, new, and its fingers have places to be. @returns whether.
  bool Add(Rest rest);
  [[nodiscard]] bool IsGrasp(const Holding& holding);
  /// Where tips roll to when the object is carried towards a node; without reserve it comes there.
  [[nodiscard]] RolledTo RollTowards(const Rest& rest, int node);
  /// Of a new rest, from `rolled_before`. @returns whether its tips hold there.
  [[nodiscard]] bool TakeRolledTips(Rest& rest);
  [[nodiscard]] bool WasExpandedAt(const Rest& rest) const;
  [[nodiscard]] double ScoreOf(const Holding& holding, int node, int slides, int last);
  /// Whether there is a way to a rest and on with it; `carried.end` is where it leads to, which
  /// may be nearer than before.
  [[nodiscard]] bool ComesToItsEnd(int index);
  /// Works out the way to a new rest. @returns the rest as it is come to; −1 where it is not.
  [[nodiscard]] int ComeTo(int index);
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
  Carrier& carrier_;
  SlideRoutes routes_;
  NextHoldings next_;
  ContactKinds kinds_;
  Crowding crowding_;
  RollingTips rolling_;
  RestTree tree_;
  TriedWays tried_;
  std::priority_queue<Waiting> queue_;
  /// Where each grasp was taken up, or could not be.
  std::map<Holding, std::vector<Taken>> taken_;
  std::map<Holding, int> failed_;  ///< times that a grasp was not come to
  /// Of each grasp the rests that were expanded.
  std::map<Holding, std::vector<int>> expanded_;
  GaitCounts counts_;
  int reached_ = 0;  ///< the farthest step
  int last_expanded_ = -1;
  std::set<Holding> targets_;  ///< kinds of them
  bool begun_ = false;
};

}  // namespace regrasp::gait
