#pragma once

#include <vector>

#include "planner/sets/contour/contour_graph.h"
#include "tests/planner/sets/contour/contact_grid.h"

namespace regrasp::contour {

/// Largest squares of contact space by asking the general force-closure test of their corners:
/// shares the meaning of a place with the planner, and nothing else.
class SquareOracle {
 public:
  SquareOracle(const object::Polygon& polygon, double half_angle);

  /// Whether both contacts can be anywhere within `half_width` of their places, independently, in
  /// one sense. Vertices of the polygon cut the square into rectangles; on each the grasps of one
  /// sense are convex, so its corners decide.
  [[nodiscard]] bool Holds(int ring_a, double x, int ring_b, double y, double half_width) const;

  /// The supremum of such half-widths, by bisection; 0 where the grasp itself is none.
  [[nodiscard]] double SizeAt(int ring_a, double x, int ring_b, double y) const;

  /// The same about a point of a piece's rectangle.
  [[nodiscard]] double SizeAt(const ContourGraph& graph, PieceIndex piece,
                              const Eigen::Vector2d& places) const;

 private:
  /// The ends of the parts of edges that lie within a length of a place, two for each edge.
  [[nodiscard]] std::vector<grasp::Contact> EndsWithin(int ring, double place,
                                                       double half_width) const;

  const object::Polygon& polygon_;
  double half_angle_;
  std::vector<int> first_edge_;
  std::vector<double> perimeter_;
};

}  // namespace regrasp::contour
