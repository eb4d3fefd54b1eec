#pragma once

#include "planner/base/angle.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::polygon {

inline PolygonGraph MakeGraph(const Polygon& polygon, double degrees, Spanning spanning) {
  return PolygonGraph(polygon, Radians(degrees), spanning);
}

[[nodiscard]] inline const char* Name(Spanning spanning) {
  return spanning == Spanning::kUniform ? "uniform" : "adaptive";
}

inline constexpr Spanning kSpannings[] = {Spanning::kUniform, Spanning::kAdaptive};

}  // namespace regrasp::polygon
