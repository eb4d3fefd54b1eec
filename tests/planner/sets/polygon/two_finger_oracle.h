#pragma once

#include <string>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/polygon_graph.h"

namespace regrasp::polygon {

/// Number of comparisons.
struct TwoFingerCount {
  int candidates = 0;
  int sets = 0;
  int switches = 0;  ///< switches with concurrent sets
};

/// Compare the 2-finger part of a graph exactly with a second method.
///
/// Candidates are decided by the cones' borders, sets by clipping the unit square of the two
/// parameters. Switches to concurrent sets are decided by the ranges of contacts, which for
/// concurrent sets come from CGAL's Boolean operations.
/// @param difference  output: all differences as text; empty if there are none.
[[nodiscard]] TwoFingerCount CompareTwoFingerSets(const object::Polygon& polygon,
                                                  const PolygonGraph& graph, double friction_angle,
                                                  std::string& difference);

}  // namespace regrasp::polygon
