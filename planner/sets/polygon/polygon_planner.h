#pragma once

#include "planner/planning/planner.h"

namespace regrasp::polygon {

/// Plans on the switching graph of a polygon (Phoka 2010, section 3.4), with a hand of four
/// fingers (at most three hold, and between 2-finger grasps two are placed at once): over all its
/// concurrent, 2-finger and parallel grasps, on edges that need not be convex. Of the grasps of
/// these types it finds every one and every switch, decided exactly.
///
/// A grasp is joined to the sets that contain it, or contain two or three of its contacts: the
/// others are then released first or placed last.
class PolygonPlanner final : public planning::Planner {
 public:
  PolygonPlanner();
  [[nodiscard]] std::optional<MemoryNeed> EstimateMemory(
      const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::GraphSummary SummarizeGraph(
      const planning::PlanRequest& request) const override;
};

}  // namespace regrasp::polygon
