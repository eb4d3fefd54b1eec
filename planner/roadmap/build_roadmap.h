#pragma once

#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/hand/hand.h"
#include "planner/planning/plan_request.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap.h"
#include "planner/roadmap/roadmap_parameters.h"

namespace regrasp::roadmap {

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
