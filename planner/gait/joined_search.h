#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/gait/gait.h"
#include "planner/gait/gait_search.h"

namespace regrasp::gait {

/// Resumable search of a gait from one initial object pose.
class StartSearch {
 public:
  virtual ~StartSearch() = default;

  /// Return whether some fingers can hold the goal grasp, if any, at the goal pose.
  [[nodiscard]] virtual bool GoalIsHeld() const { return true; }
  /// Same as GaitSearch::Run; expansions of both directions count.
  [[nodiscard]] virtual std::optional<Gait> Run(std::int64_t most_expanded,
                                                const Deadline& deadline) = 0;
  /// Return whether there is no stance to expand.
  [[nodiscard]] virtual bool IsExhausted() const = 0;
  [[nodiscard]] virtual GaitCounts counts() const = 0;
};

/// Bidirectional search of a gait from one initial object pose.
/// Searches forward from the start. If the grasps of both ends are given, also searches backward
/// from the goal until both trees contain the same contact assignment at the same pose.
class BidirectionalSearch : public StartSearch {
 public:
  /// @param memory  same as in GaitSearch. setup, memory and random outlive this object.
  /// @param simulate  simulator of edges (GaitSearch::SimulateEdges); used only if there is no
  ///     backward search.
  BidirectionalSearch(const HandSetup& setup, const PoseGrid& grid,
                      IdleConfigurations idle_configurations, const GaitEnds& ends,
                      criteria::GraspMemory& memory, RandomStream& random,
                      SimulateExecution simulate);
  BidirectionalSearch(const BidirectionalSearch&) = delete;
  BidirectionalSearch& operator=(const BidirectionalSearch&) = delete;

  [[nodiscard]] bool GoalIsHeld() const override { return forward_.GoalIsHeld(); }
  [[nodiscard]] std::optional<Gait> Run(std::int64_t most_expanded,
                                        const Deadline& deadline) override;
  /// Return whether there is no stance to expand in one of the directions.
  [[nodiscard]] bool IsExhausted() const override;
  /// Counts of both directions; `farthest` of the forward search.
  [[nodiscard]] GaitCounts counts() const override;

 private:
  std::optional<Gait> RunFromBothEnds(std::int64_t most_expanded, const Deadline& deadline);
  /// Try to connect both trees through the last expanded stance of one direction.
  /// Also adds it to the targets of the other direction.
  std::optional<Gait> Meet(bool is_forward);
  /// Plan the gait through two stances with equal assignments; nullopt if a path fails.
  std::optional<Gait> Join(int forward, int backward);
  /// Return a grid node that both stances reach, kNoNode if none is found.
  int CommonNode(int forward, int backward);
  /// Move idle fingers between their configurations in two keyframes.
  /// Moves one finger at a time, in the first feasible order.
  /// @param stuck  output: a finger without a path, if that is the cause of the failure.
  std::optional<std::vector<Keyframe>> MoveIdleFingers(const ContactAssignment& assignment,
                                                       const Keyframe& from, const Keyframe& to,
                                                       FingerIndex& stuck);

  const HandSetup& setup_;
  PoseGrid grid_;
  PoseGrid reversed_;
  IdleConfigurations idle_configurations_;
  RandomStream& random_;
  ObjectMotionChecker checker_;
  std::optional<ObjectMotionChecker>
      reversed_checker_;  ///< none if `checker_` serves both directions
  GaitSearch forward_;
  std::optional<GaitSearch> backward_;
  /// Expanded stances of the forward and the backward search, by assignment.
  std::map<ContactAssignment, std::vector<int>> from_start_, from_goal_;
};

/// Search of a rotation that may begin at any angle.
/// Searches forward from the stances at one pose, and backward from the roots that reach farthest,
/// until a forward and a backward path from one root add up to the required rotation. A full
/// rotation then avoids the angles between its end and its start, for example one at which the hand
/// reaches the object badly.
class TurnSearch : public StartSearch {
 public:
  /// @param track  track of the forward search.
  /// @param forward, backward  idle configurations of the two directions.
  /// @param memory  same as in GaitSearch. setup, memory and random outlive this object.
  TurnSearch(const HandSetup& setup, const PoseTrack& track, IdleConfigurations forward,
             IdleConfigurations backward, criteria::GraspMemory& memory, RandomStream& random);
  TurnSearch(const TurnSearch&) = delete;
  TurnSearch& operator=(const TurnSearch&) = delete;

  [[nodiscard]] std::optional<Gait> Run(std::int64_t most_expanded,
                                        const Deadline& deadline) override;
  [[nodiscard]] bool IsExhausted() const override { return forward_.IsExhausted(); }
  [[nodiscard]] GaitCounts counts() const override;

 private:
  /// Poses reached from a root in one direction.
  struct Reached {
    int farthest = 0;  ///< farthest step
    /// Pairs of stance and grid node, by step and tilt.
    std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> nodes_at;
  };
  /// Initial stance with the poses that are reached from it.
  struct Root {
    Reached forward;
    Reached backward;
    std::optional<GaitSearch> search;  ///< backward search
    [[nodiscard]] int farthest() const { return forward.farthest + backward.farthest; }
  };
  /// Return the index of the root from which the largest rotation is reached; −1 if none.
  /// Roots with an exhausted backward search are skipped.
  [[nodiscard]] int BestRoot() const;
  GaitSearch& BackwardFrom(int root);
  /// Record the poses of the last expanded stance of a direction.
  /// Tries to complete a rotation through them.
  std::optional<Gait> RecordReached(int root, bool is_forward);
  /// Plan the rotation through a forward and a backward path.
  /// @param forward, backward  pairs of stance and grid node.
  std::optional<Gait> Join(int root, std::pair<int, int> forward, std::pair<int, int> backward);

  const HandSetup& setup_;
  PoseGrid grid_;
  PoseGrid back_grid_;
  IdleConfigurations idle_configurations_;
  IdleConfigurations back_idle_configurations_;
  criteria::GraspMemory& memory_;
  RandomStream& random_;
  ObjectMotionChecker checker_;
  ObjectMotionChecker back_checker_;
  GaitSearch forward_;
  std::map<int, Root> roots_;  ///< roots, by stance
  std::set<std::pair<int, int>>
      joined_;  ///< pairs of forward and backward stances for which Join was called
};

}  // namespace regrasp::gait
