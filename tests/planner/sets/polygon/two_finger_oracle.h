#pragma once

#include <string>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/polygon_graph.h"

namespace regrasp::polygon {

/// What was compared.
struct TwoFingerCount {
  int candidates = 0;
  int sets = 0;
  int switches = 0;  ///< with concurrent sets
};

/// Compares the 2-finger part of a graph with a second route, exactly: candidates by the cones'
/// borders, sets by clipping the unit square of the two parameters, and the switches to concurrent
/// sets by their ranges of contacts, those of concurrent sets from CGAL's Boolean operations.
/// @param difference  set to what differs, left empty where nothing does.
[[nodiscard]] TwoFingerCount CompareTwoFingerSets(const object::Polygon& polygon,
                                                  const PolygonGraph& graph, double half_angle,
                                                  std::string& difference);

}  // namespace regrasp::polygon
