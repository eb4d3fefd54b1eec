#include "planner/roadmap/roadmap_planner.h"

#include "planner/base/memory.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/roadmap/cluster_search.h"
#include "planner/roadmap/contact_point_search.h"
#include "planner/roadmap/roadmap_memory.h"

namespace regrasp::roadmap {

RoadmapPlanner::RoadmapPlanner()
    : Planner({.name = "roadmap",
               .what = "grasps of contact points or clusters of them",
               .in_space = PlannerScope{kRoadmapFingers,
                                        {kRoadmapContacts, kRoadmapContacts},
                                        {kRoadmapContacts, kRoadmapContacts}},
               .options = {PlanOption::kContactPoints, PlanOption::kClusters,
                           PlanOption::kNoLastResort}}) {}

std::optional<MemoryNeed> RoadmapPlanner::EstimateMemory(const PlanRequest& request) const {
  return EstimateRoadmap(request);
}

PlanResult RoadmapPlanner::Plan(const PlanRequest& request) const {
  if (SizeOf(request).clusters > 0) return SearchClusters(request);
  return SearchContactPoints(SpreadContacts(request), request);
}

}  // namespace regrasp::roadmap
