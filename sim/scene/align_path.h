#pragma once

#include <vector>

#include "planner/plan/plan.h"

namespace regrasp::sim {

/// The contacts `share` of the path between two waypoints; normals turn on the great circle.
[[nodiscard]] plan::FingerGrasp Interpolate(const plan::FingerGrasp& from,
                                            const plan::FingerGrasp& to, double share);

/// The path of an align as one motion: t from 0 to end(), a whole number at each waypoint.
class AlignPath {
 public:
  /// @param align  at least one waypoint; each has the fingers of the first, in any order.
  explicit AlignPath(const plan::Align& align);

  [[nodiscard]] int end() const { return static_cast<int>(waypoints_.size()) - 1; }
  /// Fingers in the order of the first waypoint.
  [[nodiscard]] plan::FingerGrasp At(double t) const;
  /// How far the contacts move from `from` to `to`, all added up; turns of normals add nothing.
  [[nodiscard]] double Travel(double from, double to) const;
  /// True iff the k-th contact is between the normals of two faces at t.
  [[nodiscard]] bool IsTurning(std::size_t k, double t) const;

 private:
  std::vector<plan::FingerGrasp> waypoints_;
};

}  // namespace regrasp::sim
