#pragma once

#include <set>
#include <vector>

#include "planner/gait/gait.h"

namespace regrasp::gait {

/// The grasp that a gait is to end with, if one is asked for, and the ways in which fingers can
/// hold it.
class GoalGrasp {
 public:
  /// @param points  its contacts, by number; none: any grasp will do.
  explicit GoalGrasp(std::vector<int> points) : points_(std::move(points)) {}

  /// A way that the hand can hold it, at the goal pose.
  void AddWay(Holding way) { ways_.push_back(std::move(way)); }

  [[nodiscard]] const std::vector<int>& points() const { return points_; }
  [[nodiscard]] bool IsWithinReach() const { return points_.empty() || !ways_.empty(); }
  [[nodiscard]] bool IsHeldBy(const Holding& holding) const;
  /// Fingers that would have to be placed or lifted, at least.
  [[nodiscard]] int DistanceFrom(const Holding& holding) const;
  /// Contacts that a finger may end with.
  [[nodiscard]] std::set<int> ContactsOf(FingerIndex finger) const;

 private:
  std::vector<int> points_;
  std::vector<Holding> ways_;
};

}  // namespace regrasp::gait
