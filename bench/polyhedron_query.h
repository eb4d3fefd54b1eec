#pragma once

#include <string>

#include "planner/object/polyhedron.h"
#include "planner/planning/plan_request.h"

namespace regrasp {

/// Times of queries between two random grasps of one component of the switching graph of a solid,
/// the graph built before.
struct QueryTimes {
  int queries = 0;
  int without_plan = 0;
  int with_warning = 0;  ///< the sequence passes a grasp below the quality that is asked for
  double mean_switches = 0;
  double mean_ms = 0;
  double median_ms = 0;
  double most_ms = 0;
};

/// One query for each seed from 1 on: drawing start and goal is outside the time.
[[nodiscard]] QueryTimes TimeQueries(const object::Polyhedron& solid, double degrees,
                                     planning::Spanning spanning, int queries);

}  // namespace regrasp
