#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"
#include "planner/sets/grasp_set_model.h"
#include "planner/sets/polygon/graph_cells.h"
#include "planner/sets/polygon/set_cells.h"
#include "planner/sets/polygon/switch_point.h"

namespace regrasp::polygon {

/// The contacts' parameters that an align passes from one grasp of a set to another, both ends
/// included: straight lines inside cells, through passages where it leaves one. Fewest passages
/// first. On a straight line all contacts move at the same rate, and every grasp on it is in the
/// set.
/// @returns an empty vector where no chain of cells that doubles can tell joins the two.
[[nodiscard]] std::vector<Eigen::VectorXd> FindAlignPath(const SetCells& set,
                                                         const Eigen::VectorXd& from,
                                                         const Eigen::VectorXd& to);

/// What a PolygonGraph takes at most while it is built, within a factor of two.
///
/// The vertices on at most forty edges, drawn from all of them, are counted; vertices on three
/// edges go with the third power of how many edges there are, the joins with the square of the
/// vertices over that of the edges. What a vertex and a join take was measured.
///
/// Laws: the same polygon gives the same number; a polygon of forty edges or fewer is counted
/// whole.
[[nodiscard]] MemoryNeed EstimatePolygonGraph(const object::Polygon& polygon, double half_angle,
                                              planning::Spanning spanning);

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
