#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace regrasp::object {

/// A part of the unit interval.
using ParameterInterval = std::pair<double, double>;

/// The t in [0, 1] with distance(t) ≤ threshold, for a convex function; an interval, or none.
///
/// The ends are found from the inside, so that the function is within the threshold at both.
[[nodiscard]] std::optional<ParameterInterval> SublevelInterval(
    const std::function<double(double)>& distance, double threshold);

/// True iff the intervals cover [0, 1] without a gap.
[[nodiscard]] bool CoverUnitInterval(std::vector<ParameterInterval> intervals);

}  // namespace regrasp::object
