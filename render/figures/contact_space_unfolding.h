#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/sets/contour/set_geometry.h"
#include "render/figures/grasp_diagram.h"

namespace regrasp::render {

/// Two ends of a straight line.
using Segment = std::array<Eigen::Vector2d, 2>;

/// A set of a contour's graph laid out in the plane, free of the frame: across the end of a ring it
/// goes on, and across the axis of symmetry it is not mirrored.
struct UnfoldedSet {
  std::vector<Outline> pieces;
  std::vector<Segment> border;
  /// Where the set goes on but the plane has no space: it comes back to itself around a ring, once
  /// around the object, and is cut there.
  std::vector<Segment> cuts;
  std::vector<Segment> diagram;  ///< the L-infinity Voronoi diagram of its border
};

/// Unfolds the set of a grasp from there, piece by piece, the nearest first by passages.
///
/// Laws: the grasp lies at its own places (Phoka 2010, section 4.2.2: in the first period); pieces
/// don't overlap and have the area that the set has.
/// @param upright  which of the grasp's two places the second coordinate is, 0 or 1.
[[nodiscard]] UnfoldedSet UnfoldSet(contour::SetGeometry& geometry,
                                    const contour::PlacedGrasp& root, int upright);

/// The parts of a set's border, none longer than an edge, each with the piece that it bounds.
[[nodiscard]] std::vector<contour::BorderSegment> SplitBorder(const contour::ContourGraph& graph,
                                                              sets::SetIndex set);

}  // namespace regrasp::render
