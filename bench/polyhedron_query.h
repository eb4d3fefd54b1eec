#pragma once

#include <string>

#include "planner/object/polyhedron.h"
#include "planner/planning/plan_request.h"

namespace regrasp {

/// Times of queries between two random grasps of one component of a solid's switching graph,
/// without the construction of the graph.
struct QueryTimes {
  int queries = 0;
  int without_plan = 0;
  int with_warning = 0;  ///< number of sequences with a grasp below the required quality
  double mean_switches = 0;
  double mean_ms = 0;
  double median_ms = 0;
  double most_ms = 0;
};

/// Run one query for each seed from 1. The time to draw start and goal is excluded.
[[nodiscard]] QueryTimes TimeQueries(const object::Polyhedron& solid, double degrees,
                                     planning::Spanning spanning, int queries);

}  // namespace regrasp
