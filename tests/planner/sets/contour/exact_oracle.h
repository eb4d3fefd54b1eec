#pragma once

#include <string>

#include "planner/object/polygon.h"
#include "planner/sets/contour/contour_graph.h"

namespace regrasp::contour {

/// What was compared.
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

/// Compares a graph with a second route, in rational numbers: the unit square of the two contact
/// parameters of every pair of edges is clipped by the borders of both cones, corner by corner;
/// sets, passages and switches follow from the coordinates of the corners. Nothing is shared with
/// the planner but tan θ.
/// @param difference  set to what differs, left empty where nothing does.
[[nodiscard]] OracleCounts CompareWithRationals(const object::Polygon& polygon,
                                                const ContourGraph& graph, double half_angle,
                                                std::string& difference);

}  // namespace regrasp::contour
