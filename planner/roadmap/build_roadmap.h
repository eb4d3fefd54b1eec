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

/// The first of `points` that is the same contact: on the same face, no farther than `tolerance`.
[[nodiscard]] std::optional<int> FindContact(const std::vector<grasp::Contact>& points,
                                             const grasp::Contact& contact, double tolerance);

/// Contacts of a grasp of a roadmap, and fingers of the hand: the fifth switches.
inline constexpr int kRoadmapContacts = 4;
inline constexpr int kRoadmapFingers = hand::kFingersInSpace;
/// Contact points of a plain roadmap: more need more memory than a small machine has, 65 million
/// subsets.
inline constexpr int kMaxRoadmapContacts = 200;
/// Contact points of a clustered one: their affinities take 8 N² bytes three times over.
inline constexpr int kMaxClusteredContacts = 4000;

/// Number of contact points and of clusters of a roadmap.
///
/// Without parameters: 60 contact points and no clusters on an object of at most
/// kMaxRoadmapContacts faces; 1000 contact points in 50 clusters on an object with more faces, a
/// mesh. A given number of contact points replaces the number of faces in this rule.
struct RoadmapSize {
  int contacts = 0;
  int clusters = 0;  ///< 0: none, all subsets of four contact points are looked at
};
[[nodiscard]] RoadmapSize SizeOf(const planning::PlanRequest& request);

/// Contact points spread over the surface, or over the points that are given, that fingers of the
/// hand reach.
/// @throws std::invalid_argument  there are to be fewer than four or too many.
/// @throws NoGrasp  too few of the given points take a finger.
[[nodiscard]] std::vector<grasp::Contact> SpreadContacts(const planning::PlanRequest& request);

/// The contact points, `joined` first, tested for force closure in all fours.
[[nodiscard]] Roadmap BuildRoadmap(const planning::PlanRequest& request,
                                   const std::vector<grasp::Contact>& contacts,
                                   const std::vector<grasp::Contact>& joined = {});

/// The roadmap of representatives of clusters.
/// @throws std::invalid_argument  there are to be fewer than four contact points or too many.
/// @throws NoGrasp  too few of the given points take a finger.
[[nodiscard]] ClusteredRoadmap BuildClusteredRoadmap(const planning::PlanRequest& request);

}  // namespace regrasp::roadmap
