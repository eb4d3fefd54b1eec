#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/grasp/contact.h"
#include "planner/hand/hand.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/planning/plan_request.h"
#include "planner/roadmap/contact_clusters.h"
#include "planner/roadmap/roadmap.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/search/switching_graph.h"

namespace regrasp::roadmap {

/// Limits of the number of clusters. More representatives exceed the memory of a small machine.
inline constexpr int kFewestClusters = 4;
inline constexpr int kMostClusters = 200;

struct ClusteredRoadmapOptions {
  double friction_angle = 0;  ///< friction angle, radians in (0, π/2)
  int contacts = 1000;        ///< largest number of contact points
  int clusters = 50;          ///< kFewestClusters … kMostClusters
  std::uint64_t seed = 0;
  /// Callback for progress messages.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  double finger_radius = 0;  ///< radius of the fingers; 0: points (reach.h)
  Deadline deadline = {};    ///< deadline of the construction, which then throws TimeUp
  /// Points to which contact points are restricted (sampling/contact_points.h); null for none.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
};

/// Cluster the contact points of a mesh at which a fingertip has clearance.
/// The number of clusters is reduced to at most one less than the number of contact points.
/// @throws std::invalid_argument  if an option is out of range.
/// @throws NoGrasp  if too few of the given points accept a finger.
[[nodiscard]] ContactClusters ClusterContacts(const object::Polyhedron& solid,
                                              const ClusteredRoadmapOptions& options);

/// Clustered contact points of a mesh, with the roadmap of their representatives.
/// The roadmap has all force-closure grasps of four representatives (Phoka 2010, 6.2.2 and 6.2.3).
/// It is constant and can be shared by queries.
struct ClusteredRoadmap {
  /// @throws std::invalid_argument  if an option is out of range.
  ClusteredRoadmap(const object::Polyhedron& solid, const ClusteredRoadmapOptions& options);

  double friction_angle;
  object::WrenchFrame frame;
  ContactClusters clusters;
  Roadmap roadmap;  ///< roadmap over the representatives, in cluster order
  search::Components components;
};

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

/// Return the first of `points` that is the same contact: on the same face within `tolerance`.
[[nodiscard]] std::optional<int> FindContact(const std::vector<grasp::Contact>& points,
                                             const grasp::Contact& contact, double tolerance);

/// Number of contacts of a grasp in a roadmap, and number of fingers of the hand. The fifth finger
/// is for finger switches.
inline constexpr int kRoadmapContacts = 4;
inline constexpr int kRoadmapFingers = hand::kFingersInSpace;
/// Largest number of contact points of a roadmap without clusters. More points have more than 65
/// million subsets, which exceed the memory of a small machine.
inline constexpr int kMaxRoadmapContacts = 200;
/// Largest number of contact points of a clustered roadmap. Their affinities require 8 N² bytes
/// three times.
inline constexpr int kMaxClusteredContacts = 4000;

/// Number of contact points and of clusters of a roadmap.
///
/// Without parameters: 60 contact points and no clusters on an object of at most
/// kMaxRoadmapContacts faces; 1000 contact points in 50 clusters on an object with more faces, a
/// mesh. A given number of contact points replaces the number of faces in this rule.
struct RoadmapSize {
  int contacts = 0;
  int clusters = 0;  ///< 0: no clusters, all subsets of four contact points are tested
};
[[nodiscard]] RoadmapSize SizeOf(const planning::PlanRequest& request);

/// Return contact points spread over the surface, or over the given points, that fingers can reach.
/// @throws std::invalid_argument  if the requested number is less than four or too large.
/// @throws NoGrasp  if too few of the given points accept a finger.
[[nodiscard]] std::vector<grasp::Contact> SpreadContacts(const planning::PlanRequest& request);

/// Build the roadmap of all force-closure grasps of four contact points.
/// @param contacts  contact points.
/// @param joined  additional contact points, which are first in the roadmap.
[[nodiscard]] Roadmap BuildRoadmap(const planning::PlanRequest& request,
                                   const std::vector<grasp::Contact>& contacts,
                                   const std::vector<grasp::Contact>& joined = {});

/// Build the roadmap of the clusters' representatives.
/// @throws std::invalid_argument  if the requested number of contact points is less than four or
///     too large.
/// @throws NoGrasp  if too few of the given points accept a finger.
[[nodiscard]] ClusteredRoadmap BuildClusteredRoadmap(const planning::PlanRequest& request);

}  // namespace regrasp::roadmap
