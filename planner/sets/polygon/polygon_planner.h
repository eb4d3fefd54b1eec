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

namespace regrasp::polygon {

/// Find the waypoints of a sliding step between two grasps of a set, including both.
///
/// The path is straight inside cells and leaves a cell through a passage. It has as few passages as
/// possible. On a straight line all contacts move at the same rate, and every grasp is in the set.
/// @returns contact parameters of each waypoint; empty if no chain of cells, computed in doubles,
///     connects the two grasps.
[[nodiscard]] std::vector<Eigen::VectorXd> FindAlignPath(const SetCells& set,
                                                         const Eigen::VectorXd& from,
                                                         const Eigen::VectorXd& to);

/// Estimate the peak memory for building a PolygonGraph, within a factor of two.
///
/// The vertices on at most forty randomly drawn edges are counted. The number of vertices on three
/// edges is cubic in the number of edges. The number of switches is proportional to (vertices /
/// edges)². The memory per vertex and per switch is measured.
///
/// Laws: the result is deterministic; all edges are counted if there are at most forty.
[[nodiscard]] MemoryNeed EstimatePolygonGraph(const object::Polygon& polygon, double friction_angle,
                                              planning::Spanning spanning);

/// Model of the grasp sets of a polygon's switching graph (GraspSetModel).
class PolygonModel : public sets::EvaluatedModel<PolygonPlace> {
 public:
  /// All arguments must outlive this object. @param request  query, also with the deadline.
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
  /// Find the sets that contain a grasp or some of its contacts.
  ///
  /// If no grasp there meets the acceptance criteria, sets one switch away are added. Places that
  /// fail the criteria are dropped if another one meets them.
  [[nodiscard]] Attachments Attach(const grasp::Grasp& grasp);
  [[nodiscard]] std::string WhyUnattached(const grasp::Grasp& grasp) const;

  /// Return the switch that keeps the most contacts, among those with at least half of the best
  /// score.
  [[nodiscard]] std::optional<Switch> FindSwitch(const Ends& ends);
  [[nodiscard]] std::vector<Place> FindRoute(const Place& from, const Place& to);

 private:
  const object::Polygon& polygon_;
  const PolygonGraph& graph_;
  GraphCells cells_;
};

/// Planner on the switching graph of a polygon (Phoka 2010, section 3.4), for a hand of four
/// fingers.
///
/// It plans over all concurrent, 2-finger and parallel grasps of edges; the polygon need not be
/// convex. It finds every grasp of these types and every switch, decided exactly. At most three
/// fingers hold the object, and a switch between 2-finger grasps places two.
///
/// A grasp is connected with the sets that contain it, or that contain two or three of its
/// contacts. The other contacts are then released first or placed last.
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
