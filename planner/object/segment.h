#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace regrasp::object {

/// Return the point of the segment ab nearest to `point`; a if the segment has no length.
[[nodiscard]] inline Eigen::Vector3d ClosestOnSegment(const Eigen::Vector3d& a,
                                                      const Eigen::Vector3d& b,
                                                      const Eigen::Vector3d& point) {
  const Eigen::Vector3d along = b - a;
  const double length_squared = along.squaredNorm();
  if (!(length_squared > 0)) return a;
  const double t = (point - a).dot(along) / length_squared;
  if (t <= 0) return a;
  if (t >= 1) return b;
  return a + t * along;
}

/// Part of the unit interval.
using ParameterInterval = std::pair<double, double>;

/// Find the interval of t in [0, 1] with distance(t) ≤ threshold; nullopt if it is empty.
///
/// The ends are approached from inside, so that the function is within the threshold at both.
/// @param distance  convex function.
[[nodiscard]] std::optional<ParameterInterval> SublevelInterval(
    const std::function<double(double)>& distance, double threshold);

/// Return whether the intervals cover [0, 1] without a gap.
[[nodiscard]] bool CoverUnitInterval(std::vector<ParameterInterval> intervals);

}  // namespace regrasp::object
