#pragma once

#include "planner/planning/planner.h"

namespace regrasp::roadmap {

/// Plans finger switches between grasps of four contact points of a solid (Phoka 2010, chapter VI),
/// with a hand of kRoadmapFingers fingers: of these grasps it knows every one and every switch.
class RoadmapPlanner final : public planning::Planner {
 public:
  RoadmapPlanner();
  [[nodiscard]] std::optional<MemoryNeed> EstimateMemory(
      const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::GraphSummary SummarizeGraph(
      const planning::PlanRequest& request) const override;
};

}  // namespace regrasp::roadmap
