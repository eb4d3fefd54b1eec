#pragma once

#include <string>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// Number of comparisons, which tests expect to be positive.
struct OracleCount {
  int candidates = 0;
  int cells = 0;
  int switches = 0;
  int several = 0;    ///< combinations with several components
  int unbounded = 0;  ///< unbounded cells, which can occur at φ = φ*

  OracleCount& operator+=(const OracleCount& other);
};

/// Compare the concurrent part of a graph exactly with CGAL's Boolean operations on polygons.
///
/// Compared are candidates, tangents, components of every cell with their sides, and switches
/// between them.
/// @param difference  output: all differences as text; empty if there are none.
[[nodiscard]] OracleCount CompareWithSetOperations(const object::Polygon& polygon,
                                                   const PolygonGraph& graph, double friction_angle,
                                                   planning::Spanning spanning,
                                                   std::string& difference);

}  // namespace regrasp::polygon
