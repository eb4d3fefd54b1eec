#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"

namespace regrasp::roadmap {

/// Number of colours that distinguish neighbouring clusters.
inline constexpr int kClusterColors = 8;

/// Display of clustered contact points.
struct ClusterView {
  /// Colour by triangle of the solid, in 0 … kClusterColors − 1, uniform within a cluster. Adjacent
  /// clusters have different colours as far as there are enough colours.
  std::vector<int> color_of_triangle;
  std::vector<Eigen::Vector3d> representatives;
};

/// Recompute the clusters on which a plan was made.
/// A triangle belongs to the cluster of the nearest contact point on its side of the solid.
/// @param solid  solid read as for the plan, with its contact patches (Plan::patch_radius,
///     RoadmapNote::roughness) and with the filled surface that accepts fingers.
/// @param plan   plan with a roadmap.
/// @param given_points  points to which contacts are restricted; required with
///     Plan::at_given_points.
/// @throws InputError  if the roadmap's numbers are not those of a clustered roadmap.
[[nodiscard]] ClusterView DescribeClusters(
    const object::Polyhedron& solid, const plan::Plan& plan,
    const std::vector<Eigen::Vector3d>* given_points = nullptr);

}  // namespace regrasp::roadmap
