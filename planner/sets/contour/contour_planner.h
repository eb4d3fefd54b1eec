#pragma once

#include "planner/planning/planner.h"

namespace regrasp::contour {

/// Plans between 2-finger grasps on the switching graph of a polygon's whole boundary (Phoka 2010,
/// chapter IV), with a hand of three, of which one is placed in a switch: of these grasps it finds
/// every one and every switch, on polygons of thousands of edges.
///
/// Contacts that a switch places carry the half-width of the smaller contact region of its two
/// grasps, rounded down. Law: along the same path of sets Objective::kRegions gives every switch a
/// region at least as large as it has otherwise.
class ContourPlanner final : public planning::Planner {
 public:
  ContourPlanner();
  [[nodiscard]] std::optional<MemoryNeed> EstimateMemory(
      const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::GraphSummary SummarizeGraph(
      const planning::PlanRequest& request) const override;
};

}  // namespace regrasp::contour
