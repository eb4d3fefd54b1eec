#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/sets/grasp_set_model.h"
#include "planner/sets/polygon/graph_cells.h"
#include "planner/sets/polygon/switch_point.h"

namespace regrasp::polygon {

/// The grasp sets of a polygon's switching graph, as planning over sets sees them.
class PolygonModel : public sets::EvaluatedModel<PolygonPlace> {
 public:
  /// All outlive this object. @param request  its deadline counts too.
  PolygonModel(const object::Polygon& polygon, const PolygonGraph& graph,
               const planning::PlanRequest& request)
      : EvaluatedModel(request),
        polygon_(polygon),
        graph_(graph),
        cells_(polygon, graph, request.deadline) {}

  [[nodiscard]] const PolygonGraph& graph() const { return graph_; }
  [[nodiscard]] static std::string sets_name() { return "sets of grasps"; }
  [[nodiscard]] double WidthOf(sets::SetIndex set) { return cells_.WidthOf(set); }
  [[nodiscard]] std::optional<Place> Draw(sets::SetIndex set, RandomStream& random) {
    return cells_.Draw(set, random);
  }
  [[nodiscard]] grasp::Grasp GraspOf(const Place& place) const { return cells_.GraspOf(place); }
  /// The sets that a grasp is in, or else comes to by a switch after which, or for a goal before
  /// which, the hand rests well.
  [[nodiscard]] Attachments Attach(const grasp::Grasp& grasp);
  [[nodiscard]] std::string WhyUnattached(const grasp::Grasp& grasp) const;

  /// Of the switches with at least half of the best score the one that keeps the most contacts.
  [[nodiscard]] std::optional<Switch> FindSwitch(const Ends& ends);
  [[nodiscard]] std::vector<Place> FindRoute(const Place& from, const Place& to);

 private:
  const object::Polygon& polygon_;
  const PolygonGraph& graph_;
  GraphCells cells_;
};

}  // namespace regrasp::polygon
