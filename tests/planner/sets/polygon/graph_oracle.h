#pragma once

#include <string>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// What was compared, so that tests can expect it positive.
struct OracleCount {
  int candidates = 0;
  int cells = 0;
  int switches = 0;
  int several = 0;    ///< combinations whose cell falls apart
  int unbounded = 0;  ///< cells that reach to infinity, as they may at φ = φ*

  OracleCount& operator+=(const OracleCount& other);
};

/// Compares the concurrent part of a graph with CGAL's Boolean operations on polygons, exactly: the
/// candidates, the tangents, the components of every cell and the sides that they lie on, the
/// switches between them.
/// @param difference  set to what differs, left empty where nothing does.
[[nodiscard]] OracleCount CompareWithSetOperations(const object::Polygon& polygon,
                                                   const PolygonGraph& graph, double half_angle,
                                                   planning::Spanning spanning,
                                                   std::string& difference);

}  // namespace regrasp::polygon
