#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/sets/contour/contour_graph.h"

namespace regrasp::contour {

/// Geometry of graspable sets in contact space, in doubles: x is the place of the contact on the
/// first edge of a piece (the lower number), y that on the second, both as Boundary has them. The
/// space is periodic, and symmetric where both are on one ring; only pieces in ascending order of
/// their edges are listed.

/// A convex polygon, counter-clockwise; empty where the piece is too thin for doubles.
[[nodiscard]] std::vector<Eigen::Vector2d> PieceOutline(const ContourGraph& graph,
                                                        PieceIndex piece);

/// A straight part of the border of a set. Lines that cut a piece fall (dy/dx < 0), all others are
/// parallel to an axis and lie on the polygon's vertices.
struct BorderSegment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  PieceIndex piece;  ///< a piece that it bounds
};

/// The border of a set: what bounds its pieces and is not inside the set. Segments on one line
/// that follow each other are one. Each is listed once, as the piece's rectangle has it.
[[nodiscard]] std::vector<BorderSegment> SetBorder(const ContourGraph& graph, sets::SetIndex set);

/// The places of the staying contact at a passage: (low, high), low < high; low = high = their
/// middle where doubles cannot tell.
struct PlaceRange {
  double low = 0;
  double high = 0;
};
[[nodiscard]] PlaceRange PassageRange(const ContourGraph& graph, const PiecePassage& passage);

}  // namespace regrasp::contour
