#pragma once

#include <string>

#include "planner/object/polygon.h"
#include "planner/sets/contour/contour_graph.h"

namespace regrasp::contour {

/// Number of comparisons.
struct OracleCounts {
  int candidates = 0;
  int combinations = 0;
  int pieces = 0;
  int full = 0;  ///< pieces that are whole rectangles
  int passages = 0;
  int sets = 0;
  int switches = 0;
  int components = 0;

  OracleCounts& operator+=(const OracleCounts& other);
};

/// Compare a graph with a second method in rational numbers.
///
/// For every pair of edges, the unit square of the two contact parameters is clipped by the borders
/// of both cones. Sets, passages and switches follow from the coordinates of its corners. The
/// method shares only tan θ with the planner.
/// @param difference  output: all differences as text; empty if there are none.
[[nodiscard]] OracleCounts CompareWithRationals(const object::Polygon& polygon,
                                                const ContourGraph& graph, double friction_angle,
                                                std::string& difference);

}  // namespace regrasp::contour
