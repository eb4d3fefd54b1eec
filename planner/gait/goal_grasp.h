#pragma once

#include <set>
#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/reach_map.h"

namespace regrasp::gait {

/// The grasp that a gait is to end with, if one is asked for, and the ways in which fingers can
/// hold it.
class GoalGrasp {
 public:
  /// @param points   its contacts, by number; none: any grasp will do.
  /// @param surface  what numbers mean; outlives this object.
  GoalGrasp(std::vector<int> points, const std::vector<SurfacePoint>& surface)
      : points_(std::move(points)), surface_(surface) {}

  /// A way that the hand can hold it, at the goal pose.
  void AddWay(Holding way) { ways_.push_back(std::move(way)); }

  /// A grasp from which there is a way on to it.
  void AddTarget(Holding target) { targets_.push_back(std::move(target)); }
  /// The way or target that is nearest (DistanceFrom); null where there are none.
  [[nodiscard]] const Holding* NearestTo(const Holding& holding) const;
  /// Of those that the same fingers hold the nearest, so many at most.
  [[nodiscard]] std::vector<Holding> NearestOfSameFingers(const Holding& holding, int most) const;

  [[nodiscard]] bool IsWithinReach() const { return points_.empty() || !ways_.empty(); }
  [[nodiscard]] bool IsHeldBy(const Holding& holding) const;
  /// Fingers that are not where a way or a target has them, those that hold by how far they are
  /// from there.
  [[nodiscard]] double DistanceFrom(const Holding& holding) const;
  /// Contacts that a finger may end with.
  [[nodiscard]] std::set<int> ContactsOf(FingerIndex finger) const;

 private:
  [[nodiscard]] double DistanceBetween(int from, int to) const;
  [[nodiscard]] double DistanceBetween(const Holding& from, const Holding& to) const;

  std::vector<int> points_;
  const std::vector<SurfacePoint>& surface_;
  std::vector<Holding> ways_;
  std::vector<Holding> targets_;
};

}  // namespace regrasp::gait
