#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace regrasp::collision {

/// Points of two hulls that are nearest to each other.
struct NearestPair {
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
};

/// The nearest points of the convex hulls of two sets of points, by the algorithm of Gilbert,
/// Johnson and Keerthi (1988): their distance is the least to a relative 1e-9 where it converges.
/// @param a, b  at least one point each.
/// @returns nullopt where the hulls meet, up to rounding.
[[nodiscard]] std::optional<NearestPair> FindNearestPoints(std::span<const Eigen::Vector3d> a,
                                                           std::span<const Eigen::Vector3d> b);

}  // namespace regrasp::collision
