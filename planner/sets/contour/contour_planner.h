#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"
#include "planner/sets/contour/contour_switch.h"
#include "planner/sets/grasp_set_model.h"

namespace regrasp::contour {

/// Model of the sets of 2-finger grasps of a contour's switching graph (GraspSetModel).
class ContourModel : public sets::EvaluatedModel<PlacedGrasp> {
 public:
  /// @param graph  must outlive this object.
  /// @param request  query, also with objective and deadline.
  ContourModel(const ContourGraph& graph, const planning::PlanRequest& request)
      : EvaluatedModel(request),
        geometry_(graph, request.deadline),
        objective_(request.objective) {}

  [[nodiscard]] const ContourGraph& graph() const { return geometry_.graph(); }
  [[nodiscard]] static std::string sets_name() { return "sets of 2-finger grasps"; }
  [[nodiscard]] double WidthOf(sets::SetIndex set) { return geometry_.WidthOf(set); }
  [[nodiscard]] std::optional<Place> Draw(sets::SetIndex set, RandomStream& random) {
    return geometry_.Draw(set, random);
  }
  [[nodiscard]] grasp::Grasp GraspOf(const Place& place) const { return geometry_.GraspOf(place); }
  [[nodiscard]] Attachments Attach(const grasp::Grasp& grasp) const;
  [[nodiscard]] std::string WhyUnattached(const grasp::Grasp& grasp) const;

  /// Find a switch well inside both sets. If it does not meet the criteria, find the one with the
  /// best score.
  [[nodiscard]] std::optional<Switch> FindSwitch(const Ends& ends);
  /// With Objective::kRegions, replace a switch by the one with the largest contact regions.
  ///
  /// The replacement must meet the criteria, or the given switch must not meet them either.
  /// @returns half-width of the smaller contact region of its two grasps, rounded down.
  [[nodiscard]] std::optional<double> Refine(Switch& change);
  [[nodiscard]] std::vector<Place> FindRoute(const Place& from, const Place& to);

 private:
  [[nodiscard]] double RegionOf(const Switch& change);
  [[nodiscard]] bool IsGood(const Switch& change) const;

  SetGeometry geometry_;
  planning::Objective objective_;
  /// Switches with the largest regions by the sets before and after, shared by all paths.
  std::map<std::pair<sets::SetIndex, sets::SetIndex>, std::optional<Switch>> largest_;
};

/// Estimate the peak memory for building a ContourGraph, within a factor of two.
///
/// The number of nearly opposite pairs of edges (within 2θ) is counted exactly. The fraction of
/// pairs with pieces is estimated from ten thousand of them. The number of connected sets is
/// counted on at most four hundred edges, drawn in runs. The number of pieces is quadratic in the
/// number of edges, the number of switches cubic. The memory per piece and per switch is measured.
///
/// Law: the result is deterministic.
[[nodiscard]] MemoryNeed EstimateContourGraph(const object::Polygon& polygon,
                                              double friction_angle);

/// Estimate the peak memory for planning: the graph and the geometry of the sets that the search
/// evaluates.
[[nodiscard]] MemoryNeed EstimateContourPlan(const object::Polygon& polygon, double friction_angle);

/// Planner between 2-finger grasps on the switching graph of a polygon's whole boundary (Phoka
/// 2010, chapter IV), for a hand of three fingers.
///
/// A switch places one finger. The planner finds every such grasp and every switch, on polygons of
/// thousands of edges. New contacts of a switch have the half-width of the smaller contact region
/// of its two grasps, rounded down. Law: along the same path of sets, the region of each switch
/// with Objective::kRegions is at least as large as without.
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
