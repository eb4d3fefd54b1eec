#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/sets/contour/contour_graph.h"

namespace regrasp::contour {

/// Geometry of graspable sets in contact space, in doubles. x is the place of the contact on the
/// first edge of a piece (the one with the lower index), y the place on the second edge; see
/// Boundary. The space is periodic, and symmetric if both edges are on one ring. Only pieces with
/// ascending edges are listed.

/// Compute the outline of a piece: a convex counter-clockwise polygon; empty if the piece is too
/// thin for doubles.
[[nodiscard]] std::vector<Eigen::Vector2d> PieceOutline(const ContourGraph& graph,
                                                        PieceIndex piece);

/// Straight part of the border of a set.
///
/// Lines that cut a piece have dy/dx < 0. All other parts are parallel to an axis and pass a vertex
/// of the polygon.
struct BorderSegment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  PieceIndex piece;  ///< a piece that it bounds
};

/// Compute the border of a set: the borders of its pieces except those inside the set.
///
/// Consecutive segments on one line are joined. Each segment is listed once, at its position in the
/// piece's rectangle.
[[nodiscard]] std::vector<BorderSegment> SetBorder(const ContourGraph& graph, sets::SetIndex set);

/// Places of the fixed contact at a passage: (low, high) with low < high. If doubles cannot
/// separate them, low = high = their mean.
struct PlaceRange {
  double low = 0;
  double high = 0;
};
[[nodiscard]] PlaceRange PassageRange(const ContourGraph& graph, const PiecePassage& passage);

}  // namespace regrasp::contour
