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

/// The sets of 2-finger grasps of a contour's switching graph, as planning over sets sees them.
class ContourModel : public sets::EvaluatedModel<PlacedGrasp> {
 public:
  /// @param graph  outlives this object. @param request  its objective and deadline count too.
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

  /// Well inside both sets; where that is not good, the best by its score.
  [[nodiscard]] std::optional<Switch> FindSwitch(const Ends& ends);
  /// Under Objective::kRegions the switch with the largest regions whose grasps are good, where
  /// there is one with larger regions than this one.
  /// @returns the half-width of the smaller contact region of its two grasps, rounded down.
  [[nodiscard]] std::optional<double> Refine(Switch& change);
  [[nodiscard]] std::vector<Place> FindRoute(const Place& from, const Place& to);

 private:
  [[nodiscard]] double RegionOf(const Switch& change);
  [[nodiscard]] bool IsGood(const Switch& change) const;

  SetGeometry geometry_;
  planning::Objective objective_;
  /// Of the largest regions, found once for all paths, by the sets before and after.
  std::map<std::pair<sets::SetIndex, sets::SetIndex>, std::optional<Switch>> largest_;
};

/// What a ContourGraph takes at most while it is built, within a factor of two.
///
/// The pairs of edges that are opposite but for 2θ are counted; how many have pieces is tested on
/// ten thousand of them, how many sets of pieces are joined on at most four hundred edges, drawn
/// from all of them in runs. Pieces go with the square of how many edges there are, joins with the
/// third power. What a piece and a join take was measured.
///
/// Law: the same polygon gives the same number.
[[nodiscard]] MemoryNeed EstimateContourGraph(const object::Polygon& polygon, double half_angle);

/// The same for what PlanOnContour takes: also the geometry of the sets that it looks at.
[[nodiscard]] MemoryNeed EstimateContourPlan(const object::Polygon& polygon, double half_angle);

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
