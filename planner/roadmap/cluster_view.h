#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"

namespace regrasp::roadmap {

/// Colours that neighbouring clusters are told apart by.
inline constexpr int kClusterColors = 8;

/// What a picture shows of clustered contact points.
struct ClusterView {
  /// By triangle of the solid: a number in 0 … kClusterColors − 1, the same all over a cluster. Two
  /// clusters that meet have different ones, as far as there are enough.
  std::vector<int> color_of_triangle;
  std::vector<Eigen::Vector3d> representatives;
};

/// The clusters that a plan was made on, found anew. A triangle belongs to the cluster of the
/// nearest contact point on its side of the body.
/// @param solid  read as for the plan: with the patches (Plan::patch_radius,
/// RoadmapNote::roughness)
///               and the invented surface that take fingers.
/// @param plan   with a roadmap.
/// @param given_points  where Plan::at_given_points.
/// @throws InputError  the note's numbers are none of a roadmap of clusters.
[[nodiscard]] ClusterView DescribeClusters(
    const object::Polyhedron& solid, const plan::Plan& plan,
    const std::vector<Eigen::Vector3d>* given_points = nullptr);

}  // namespace regrasp::roadmap
