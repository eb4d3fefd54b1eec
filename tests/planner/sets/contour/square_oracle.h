#pragma once

#include <vector>

#include "planner/sets/contour/contour_graph.h"
#include "tests/planner/sets/contour/contact_grid.h"

namespace regrasp::contour {

/// Largest squares of contact space, found by the general force-closure test of their corners. The
/// class shares only the definition of a place with the planner.
class SquareOracle {
 public:
  SquareOracle(const object::Polygon& polygon, double friction_angle);

  /// Return whether both contacts can move independently by `half_width` and stay a grasp in one
  /// sense.
  ///
  /// Vertices of the polygon divide the square into rectangles. In each of them the grasps of one
  /// sense are convex, so the corners decide.
  [[nodiscard]] bool Holds(int ring_a, double x, int ring_b, double y, double half_width) const;

  /// Compute the supremum of these half-widths by bisection; 0 if the contacts are not a grasp.
  [[nodiscard]] double SizeAt(int ring_a, double x, int ring_b, double y) const;

  /// Compute the same for a point of a piece's rectangle.
  [[nodiscard]] double SizeAt(const ContourGraph& graph, PieceIndex piece,
                              const Eigen::Vector2d& places) const;

 private:
  /// Return the ends of the parts of edges within a length of a place, two per edge.
  [[nodiscard]] std::vector<grasp::Contact> EndsWithin(int ring, double place,
                                                       double half_width) const;

  const object::Polygon& polygon_;
  double friction_angle_;
  std::vector<int> first_edge_;
  std::vector<double> perimeter_;
};

}  // namespace regrasp::contour
