#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/sets/contour/contact_space.h"

namespace regrasp::contour {

/// Part of an edge of the L∞ Voronoi diagram of a set's border, inside one piece.
///
/// The half-width of the largest square in the set about a point of the edge is linear along the
/// edge.
struct DiagramEdge {
  PieceIndex piece;
  Eigen::Vector2d from;  ///< point of contact space (PieceOutline)
  Eigen::Vector2d to;
  double from_size = 0;  ///< half-width of the largest centred square
  double to_size = 0;
};

/// L∞ distance to the border of a set. The border includes copies under the symmetry (x, y) → (y,
/// x) and the periods of contact space, if they can touch a square inside the set.
class RegionMetric {
 public:
  /// @param graph  must outlive this object.
  RegionMetric(const ContourGraph& graph, sets::SetIndex set);

  /// Compute the half-width of the largest square in the set about a point: the L∞ distance to the
  /// border.
  ///
  /// Both contacts can move by this length along the boundary, independently, and the grasp stays
  /// in the set.
  [[nodiscard]] double SizeAt(const Eigen::Vector2d& point) const;

  /// Compute the diagram inside the set (Papadopoulou and Lee 2001; Phoka 2010, section 4.6.2),
  /// split at the borders of pieces.
  ///
  /// If one contact is fixed, the largest centred square is centred on the diagram.
  /// @throws TimeUp  if the deadline is reached.
  [[nodiscard]] std::vector<DiagramEdge> MakeDiagram(const Deadline& deadline = {}) const;

  /// Border segment, parallel to an axis or with dy/dx < 0: its box, and its normal if it is not
  /// parallel to an axis.
  struct Site {
    Eigen::Vector2d low;  ///< lower corner of the bounding box
    Eigen::Vector2d high;
    Eigen::Vector2d normal =
        Eigen::Vector2d::Zero();  ///< normal with |nx| + |ny| = 1; zero if parallel to an axis
    double offset = 0;            ///< normal · x for the points x of its line
  };

 private:
  const ContourGraph& graph_;
  sets::SetIndex set_;
  std::vector<Site> sites_;
  double rounding_ = 0;  ///< lengths that differ by less are equal
};

}  // namespace regrasp::contour
