#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace regrasp::object {

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
