#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/gait/gait_search.h"
#include "planner/gait/place_search.h"

namespace regrasp::gait {

/// Searches a gait from one place in the hand: from its start, and, where the grasps of both ends
/// are given, from its goal as well, until the two meet in one grasp at one pose.
class BidirectionalSearch : public PlaceSearch {
 public:
  /// @param memory     as in GaitSearch. setup, memory and random outlive this object.
  /// @param carry_out  as GaitSearch::TryWays, where there is but one end.
  BidirectionalSearch(const HandSetup& setup, const PoseGrid& grid, Parking parking,
                      const GaitEnds& ends, criteria::GraspMemory& memory, RandomStream& random,
                      CarryOut carry_out);
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
  std::optional<std::vector<Keyframe>> MoveFreeFingers(const Holding& holding, const Keyframe& from,
                                                       const Keyframe& to, FingerIndex& stuck);

  const HandSetup& setup_;
  PoseGrid grid_;
  PoseGrid reversed_;
  Parking parking_;
  RandomStream& random_;
  Carrier carrier_;
  std::optional<Carrier> reversed_carrier_;  ///< none: the other one serves both
  GaitSearch forward_;
  std::optional<GaitSearch> backward_;
  /// Rests that were expanded from the start and from the goal, by their grasp.
  std::map<Holding, std::vector<int>> from_start_, from_goal_;
};

}  // namespace regrasp::gait
