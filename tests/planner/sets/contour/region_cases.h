#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/sets/contour/contour_graph.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {

/// Return the tolerance of lengths in contact space, 1e-9 of the boundary.
///
/// Bisection ends at 1e-12 of it, and the force-closure test is undecided within 1e-12 of its
/// border.
[[nodiscard]] double SizeToleranceOf(const object::Polygon& polygon);

/// Return the polygons for tests of regions: the twelve-edge polygons, the degenerate ones (also
/// with perturbations of 1e-13), discs and an annulus with sets around their rings, and an outline
/// with many edges.
[[nodiscard]] const std::vector<NamedPolygon>& RegionPolygons();

/// Call work(polygon, graph, friction angle) for every one of RegionPolygons and several angles.
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
