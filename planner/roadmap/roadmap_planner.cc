#include "planner/roadmap/roadmap_planner.h"

#include "planner/base/memory.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/roadmap/cluster_search.h"
#include "planner/roadmap/contact_point_search.h"
#include "planner/roadmap/roadmap_memory.h"

namespace regrasp::roadmap {

RoadmapPlanner::RoadmapPlanner()
    : planning::Planner(
          {.name = "roadmap",
           .what = "grasps of contact points or clusters of them",
           .in_space = planning::PlannerScope{kRoadmapFingers,
                                              {kRoadmapContacts, kRoadmapContacts},
                                              {kRoadmapContacts, kRoadmapContacts}},
           .options = {planning::PlanOption::kContactPoints, planning::PlanOption::kClusters,
                       planning::PlanOption::kNoLastResort}}) {}

std::optional<MemoryNeed> RoadmapPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  return EstimateRoadmap(request);
}

planning::PlanResult RoadmapPlanner::Plan(const planning::PlanRequest& request) const {
  if (SizeOf(request).clusters > 0) return SearchClusters(request);
  return SearchContactPoints(SpreadContacts(request), request);
}

}  // namespace regrasp::roadmap
