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
inline constexpr char kFocusPointsOption[] = "--sampling";

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

/// What a PolyhedronGraph takes at most while it is built, within a factor of two.
///
/// The candidates among at most sixty faces, drawn from all of them, are counted; they go with the
/// fourth power of how many faces there are. How many of them have a cell, how many cells are
/// joined and what these take was measured.
///
/// Laws: the same solid gives the same number; a solid of sixty faces or fewer has its candidates
/// counted whole.
[[nodiscard]] MemoryNeed EstimatePolyhedronGraph(const object::Polyhedron& solid, double half_angle,
                                                 planning::Spanning spanning);

/// Plans between concurrent grasps of four fingers on four faces of a solid, on its switching graph
/// (Phoka 2010, chapter V), with a hand of five, of which one switches: of these grasps it
/// knows every set and every switch, but for what is too close to call.
class PolyhedronPlanner final : public planning::Planner {
 public:
  /// @param graph  that is built already, with the half-angle and the spanning of all requests that
  ///               follow: many queries, one graph. nullptr: each builds its own.
  explicit PolyhedronPlanner(PolyhedronGraph* graph = nullptr);
  [[nodiscard]] std::optional<MemoryNeed> EstimateMemory(
      const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::GraphSummary SummarizeGraph(
      const planning::PlanRequest& request) const override;

 private:
  /// The graph that is built already, or else the request's, made in `own`.
  PolyhedronGraph& GraphFor(const planning::PlanRequest& request,
                            std::optional<PolyhedronGraph>& own) const;

  PolyhedronGraph* graph_;
};

}  // namespace regrasp::polyhedron
