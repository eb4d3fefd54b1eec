#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/grasp_choice.h"
#include "planner/planning/plan_result.h"
#include "planner/planning/spanning.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace regrasp {

struct PolyhedronPlanOptions {
  double half_angle = 0;  ///< friction, radians in (0, π/2)
  Spanning spanning = Spanning::kAdaptive;
  std::uint64_t seed = 0;
  /// Quality that random grasps have at least, and the sequence's grasps where there is a way.
  double min_quality = 0.01;
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  double finger_radius = 0;  ///< of fingers that are not points (reach.h)
  /// Bytes that the graph may take; where it would take more there is no plan.
  double memory = std::numeric_limits<double>::infinity();
  /// When there is no plan, unless one of lower quality was found.
  Deadline deadline = {};
};

/// Plans a sequence of switches and aligns between concurrent grasps of four fingers on the
/// switching graph of a solid (Phoka 2010, chapter V), with a hand of kPolyhedronFingers fingers.
///
/// Among the paths with the fewest switches the one through the widest cells is taken. Each switch
/// happens where its focus point is deepest inside the volumes of all five faces, unless the grasp
/// at hand or the goal serves nearly as well. Where a switch's grasps are below `min_quality`,
/// paths without it are tried; where there is none, a warning names the weakest step.
///
/// Laws: the same arguments give the same plan, bit for bit; a goal equal to the start as a set
/// gives no steps; every grasp at rest and on the way is force closure.
/// @throws InputError             a given grasp does not serve (CheckGivenGrasp).
/// @throws std::invalid_argument  an option is out of its range.
[[nodiscard]] PlanResult PlanOnPolyhedron(const Polyhedron& solid, const GraspChoice& start,
                                          const GraspChoice& goal,
                                          const PolyhedronPlanOptions& options);

/// The same on a graph that is built already: many queries, one graph.
/// @param graph  of `solid`, with the half-angle and the spanning of `options`.
[[nodiscard]] PlanResult PlanOnPolyhedron(const Polyhedron& solid, PolyhedronGraph& graph,
                                          const GraspChoice& start, const GraspChoice& goal,
                                          const PolyhedronPlanOptions& options);

}  // namespace regrasp
