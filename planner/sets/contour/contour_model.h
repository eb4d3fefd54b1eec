#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/planning/plan_request.h"
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

}  // namespace regrasp::contour
