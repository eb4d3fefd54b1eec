#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace regrasp::sim {

/// The hull of some points, grown by a radius, where it is.
struct ConvexBody {
  std::vector<Eigen::Vector3d> points;
  double radius = 0;
  /// A ball that contains it.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double reach = 0;
};

/// With its ball.
[[nodiscard]] ConvexBody MakeConvexBody(std::vector<Eigen::Vector3d> points, double radius);

/// True only where two solids are certainly more than `gap` apart (negative: overlap by less than
/// that, as far as the radii go). By the pairwise Frank-Wolfe method (Lacoste-Julien and Jaggi
/// 2015), which goes to the nearest points of the hulls, until a plane between them shows it.
[[nodiscard]] bool HaveGap(const ConvexBody& a, const ConvexBody& b, double gap);

/// How near two things are, for people: to about a thousandth.
struct Nearness {
  /// Negative where they overlap: by how far the first one has to move to come free, along the best
  /// of some directions.
  double gap = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< between the points that are nearest
};

/// How near a solid is to the nearest of others. Of one deep inside only the hulls' radii count,
/// until FreeingDistance says more: its gap is at least the one that is told.
/// @param others  at least one.
[[nodiscard]] Nearness NearestOf(const ConvexBody& solid, std::span<const ConvexBody> others);

/// How far a solid has to move to have no part in common with others, along the best of some
/// directions of length 1, to 1 % and no finer than 1 µm.
[[nodiscard]] double FreeingDistance(const ConvexBody& solid, std::span<const ConvexBody> others,
                                     std::span<const Eigen::Vector3d> directions);

}  // namespace regrasp::sim
