#pragma once

#include <string>
#include <vector>

#include "planner/base/angle.h"
#include "planner/object/polygon.h"
#include "planner/sets/polygon/polygon_graph.h"

namespace regrasp {

using Ring = std::vector<Eigen::Vector2d>;

/// A polygon with a name for messages.
struct NamedPolygon {
  std::string name;
  Polygon polygon;
};

/// Polygons of 4 to 9 edges, none of them with a symmetry: convex, concave, with a hole.
[[nodiscard]] const std::vector<NamedPolygon>& SmallPolygons();

/// A regular polygon about the origin, as near as doubles come; the first edge is at the bottom.
[[nodiscard]] Polygon RegularPolygon(int n);

/// x in [0, size], y in [0, size]; exact.
[[nodiscard]] Polygon Square(double size);

[[nodiscard]] PolygonGraph MakeGraph(const Polygon& polygon, double degrees, Spanning spanning);

[[nodiscard]] const char* Name(Spanning spanning);

inline constexpr Spanning kSpannings[] = {Spanning::kUniform, Spanning::kAdaptive};

}  // namespace regrasp
