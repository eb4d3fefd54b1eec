#pragma once

#include "planner/base/number.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::polygon {

inline PolygonGraph MakeGraph(const object::Polygon& polygon, double degrees,
                              planning::Spanning spanning) {
  return PolygonGraph(polygon, Radians(degrees), spanning);
}

/// Return edges of a polygon by their numbers.
[[nodiscard]] inline std::vector<FaceIndex> Edges(const std::vector<int>& numbers) {
  return {numbers.begin(), numbers.end()};
}

[[nodiscard]] inline const char* Name(planning::Spanning spanning) {
  return spanning == planning::Spanning::kUniform ? "uniform" : "adaptive";
}

inline constexpr planning::Spanning kSpannings[] = {planning::Spanning::kUniform,
                                                    planning::Spanning::kAdaptive};

}  // namespace regrasp::polygon
