#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/sets/contour/contact_space.h"

namespace regrasp::contour {

/// A part of an edge of the L-infinity Voronoi diagram of a set's border, inside one piece. The
/// half-width of the largest square about a point of it that lies in the set changes evenly from
/// one end to the other.
struct DiagramEdge {
  PieceIndex piece;
  Eigen::Vector2d from;  ///< in contact space, as PieceOutline has it
  Eigen::Vector2d to;
  double from_size = 0;  ///< half-width of the largest centred square
  double to_size = 0;
};

/// The border of a set as centred squares see it: copies of its segments under the symmetry of the
/// space (x, y) → (y, x) and its periods, as far as they can touch a square inside the set.
class RegionMetric {
 public:
  /// `graph` must outlive this object.
  RegionMetric(const ContourGraph& graph, sets::SetIndex set);

  /// Half-width of the largest square (in the L-infinity metric: the distance to the border) about
  /// a point of the set: the two contacts may be anywhere within that length along the boundary,
  /// independently, and the grasp stays in the set.
  [[nodiscard]] double SizeAt(const Eigen::Vector2d& point) const;

  /// The diagram (Papadopoulou and Lee 2001; Phoka 2010, section 4.6.2) inside the set, cut where
  /// pieces end. When one contact is held, the largest centred square is centred on it.
  /// @throws TimeUp  the deadline came.
  [[nodiscard]] std::vector<DiagramEdge> MakeDiagram(const Deadline& deadline = {}) const;

  /// A segment, rising nowhere: its box, and for a falling one its normal.
  struct Site {
    Eigen::Vector2d low;  ///< of its bounding box
    Eigen::Vector2d high;
    Eigen::Vector2d normal =
        Eigen::Vector2d::Zero();  ///< over |nx| + |ny|; zero if parallel to an axis
    double offset = 0;            ///< of the points x on its line, normal · x = offset
  };

 private:
  const ContourGraph& graph_;
  sets::SetIndex set_;
  std::vector<Site> sites_;
  double rounding_ = 0;  ///< lengths this close are equal
};

}  // namespace regrasp::contour
