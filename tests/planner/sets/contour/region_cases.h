#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/sets/contour/contour_graph.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {

/// Lengths of contact space agree to this, 1e-9 of the boundary: bisection ends at 1e-12 of it, and
/// the force-closure test leaves out what is within 1e-12 of its border.
[[nodiscard]] double SizeToleranceOf(const object::Polygon& polygon);

/// The twelve-edge and the degenerate polygons, the latter once more with roundings of 1e-13; discs
/// and an annulus, whose sets go around their rings; an outline of many edges.
[[nodiscard]] const std::vector<NamedPolygon>& RegionPolygons();

/// Calls work(polygon, graph, half-angle) for every one of RegionPolygons and some angles.
template <class Work>
void ForEachRegionGraph(const Work& work) {
  for (const auto& [name, polygon] : RegionPolygons()) {
    for (const double degrees : {10.0, 20.0, 50.0}) {
      SCOPED_TRACE(name + " " + std::to_string(degrees));
      const ContourGraph graph(polygon, Radians(degrees));
      work(polygon, graph, Radians(degrees));
    }
  }
}

}  // namespace regrasp::contour
