#pragma once

#include <Eigen/Core>
#include <span>

namespace regrasp::object {

/// The largest distance between two of the points; 0 for fewer than two.
///
/// Exact up to the rounding of one distance. n log n in practice: a k-d tree finds the farthest
/// point of each that is far enough out to be an end. Laws: independent of the order; scales with
/// the points.
[[nodiscard]] double ComputeDiameter(std::span<const Eigen::Vector3d> points);

}  // namespace regrasp::object
