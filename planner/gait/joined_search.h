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

/// A search of a gait from one place in the hand, which goes on as often as it is asked to.
class StartSearch {
 public:
  virtual ~StartSearch() = default;

  /// Whether some fingers can hold the goal grasp, if there is one, at the goal pose.
  [[nodiscard]] virtual bool GoalIsHeld() const { return true; }
  /// As GaitSearch::Run; rests from both ends count.
  [[nodiscard]] virtual std::optional<Gait> Run(std::int64_t most_expanded,
                                                const Deadline& deadline) = 0;
  /// Whether nothing is left to expand.
  [[nodiscard]] virtual bool IsExhausted() const = 0;
  [[nodiscard]] virtual GaitCounts counts() const = 0;
};

/// Searches a gait from one place in the hand: from its start, and, where the grasps of both ends
/// are given, from its goal as well, until the two meet in one grasp at one pose.
class BidirectionalSearch : public StartSearch {
 public:
  /// @param memory     as in GaitSearch. setup, memory and random outlive this object.
  /// @param carry_out  as GaitSearch::SimulateEdges, where there is but one end.
  BidirectionalSearch(const HandSetup& setup, const PoseGrid& grid, IdlePostures idle_postures,
                      const GaitEnds& ends, criteria::GraspMemory& memory, RandomStream& random,
                      SimulateExecution carry_out);
  BidirectionalSearch(const BidirectionalSearch&) = delete;
  BidirectionalSearch& operator=(const BidirectionalSearch&) = delete;

  [[nodiscard]] bool GoalIsHeld() const override { return forward_.GoalIsHeld(); }
  [[nodiscard]] std::optional<Gait> Run(std::int64_t most_expanded,
                                        const Deadline& deadline) override;
  /// Whether nothing is left to expand from one of the ends.
  [[nodiscard]] bool IsExhausted() const override;
  /// Of both ends; what was reached from the start.
  [[nodiscard]] GaitCounts counts() const override;

 private:
  std::optional<Gait> RunFromBothEnds(std::int64_t most_expanded, const Deadline& deadline);
  /// Tells the other end of the rest that one end expanded last, and looks for gaits through it.
  std::optional<Gait> Meet(bool is_forward);
  /// The gait through two rests with one grasp, where it is free.
  std::optional<Gait> Join(int forward, int backward);
  /// The node to which both rests can be carried, kNoNode where none is found.
  int CommonNode(int forward, int backward);
  /// Brings fingers that hold nothing from where they wait in one keyframe to where they do in
  /// another one, one after the other in some order.
  /// @param stuck  one that finds no way, where it is the fingers' fault.
  std::optional<std::vector<Keyframe>> MoveFreeFingers(const ContactAssignment& holding,
                                                       const Keyframe& from, const Keyframe& to,
                                                       FingerIndex& stuck);

  const HandSetup& setup_;
  PoseGrid grid_;
  PoseGrid reversed_;
  IdlePostures idle_postures_;
  RandomStream& random_;
  ObjectMotionChecker checker_;
  std::optional<ObjectMotionChecker> reversed_checker_;  ///< none: the other one serves both
  GaitSearch forward_;
  std::optional<GaitSearch> backward_;
  /// Rests that were expanded from the start and from the goal, by their grasp.
  std::map<ContactAssignment, std::vector<int>> from_start_, from_goal_;
};

/// Searches a turn that may begin at any angle: from rests at one pose onwards, and from those of
/// them that come farthest backwards, until the two ways with one of them make up the turn. What
/// lies between the end and the start of a whole turn is never passed, so that a posture or a side
/// of the object that the hand does not master need not be where it happens to begin.
class TurnSearch : public StartSearch {
 public:
  /// @param track    from a pose onwards.
  /// @param parking  for the way onwards, and the one backwards.
  /// @param memory   as in GaitSearch. setup, memory and random outlive this object.
  TurnSearch(const HandSetup& setup, const PoseTrack& track, IdlePostures onwards,
             IdlePostures backwards, criteria::GraspMemory& memory, RandomStream& random);
  TurnSearch(const TurnSearch&) = delete;
  TurnSearch& operator=(const TurnSearch&) = delete;

  [[nodiscard]] std::optional<Gait> Run(std::int64_t most_expanded,
                                        const Deadline& deadline) override;
  [[nodiscard]] bool IsExhausted() const override { return onwards_.IsExhausted(); }
  [[nodiscard]] GaitCounts counts() const override;

 private:
  /// Where the object was brought from a first rest in one direction.
  struct Reached {
    int farthest = 0;  ///< step
    /// By step and tilt: rests, and the node.
    std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> places;
  };
  /// A first rest, and what it leads to.
  struct Root {
    Reached onwards;
    Reached backwards;
    std::optional<GaitSearch> search;  ///< backwards
    [[nodiscard]] int farthest() const { return onwards.farthest + backwards.farthest; }
  };
  /// The first rest from which the object comes farthest and that can go on backwards; −1: none.
  [[nodiscard]] int BestRoot() const;
  GaitSearch& BackwardsFrom(int root);
  /// Takes down where a search's last rest brings the object, and looks for turns through it.
  std::optional<Gait> TakeDown(int root, bool is_onwards);
  /// @param onwards, backwards  rest and node.
  std::optional<Gait> Join(int root, std::pair<int, int> onwards, std::pair<int, int> backwards);

  const HandSetup& setup_;
  PoseGrid grid_;
  PoseGrid back_grid_;
  IdlePostures idle_postures_;
  IdlePostures back_idle_postures_;
  criteria::GraspMemory& memory_;
  RandomStream& random_;
  ObjectMotionChecker checker_;
  ObjectMotionChecker back_checker_;
  GaitSearch onwards_;
  std::map<int, Root> roots_;                 ///< by rest
  std::set<std::pair<int, int>> simulation_;  ///< of one root's rests onwards and backwards
};

}  // namespace regrasp::gait
