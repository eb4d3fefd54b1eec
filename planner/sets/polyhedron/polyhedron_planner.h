#pragma once

#include <string>
#include <vector>

#include "planner/base/memory.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace regrasp::polyhedron {

/// Option of the planner `polyhedron`, as users write it.
inline constexpr char kFocusPointsOption[] = "--planner sampling";

/// Parameters of the planner `polyhedron` in PlanRequest::parameters, in addition to those in
/// sets/set_parameters.h.
struct PolyhedronParameters {
  /// Number of random focus points with which SummarizeGraph samples cells; 0: the direct graph.
  int focus_points = 0;

  [[nodiscard]] std::vector<std::string> Options() const {
    if (focus_points == 0) return {};
    return {kFocusPointsOption};
  }
};

/// Estimate the peak memory for building a PolyhedronGraph, within a factor of two.
///
/// The candidates among at most sixty randomly drawn faces are counted. Their number grows with the
/// fourth power of the number of faces. The fractions of candidates with cells and of connected
/// cells are measured, and so is the memory per element.
///
/// Laws: the result is deterministic; all candidates are counted if there are at most sixty faces.
[[nodiscard]] MemoryNeed EstimatePolyhedronGraph(const object::Polyhedron& solid,
                                                 double friction_angle,
                                                 planning::Spanning spanning);

/// Planner between concurrent grasps of four fingers on four faces of a solid (Phoka 2010, chapter
/// V), for a hand of five fingers.
///
/// It plans on the switching graph of these grasps; a switch places one finger. It finds every
/// grasp set and every switch, except numerically undecidable ones.
class PolyhedronPlanner final : public planning::Planner {
 public:
  /// @param graph  existing graph for the friction angle and spanning rule of all later requests,
  ///     so that it serves many queries. nullptr: each request builds its own.
  explicit PolyhedronPlanner(PolyhedronGraph* graph = nullptr);
  [[nodiscard]] std::optional<MemoryNeed> EstimateMemory(
      const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::GraphSummary SummarizeGraph(
      const planning::PlanRequest& request) const override;

 private:
  /// Return the existing graph; if there is none, build the request's graph in `own`.
  PolyhedronGraph& GraphFor(const planning::PlanRequest& request,
                            std::optional<PolyhedronGraph>& own) const;

  PolyhedronGraph* graph_;
};

}  // namespace regrasp::polyhedron
