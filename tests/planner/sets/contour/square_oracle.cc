#include "tests/planner/sets/contour/square_oracle.h"

#include <algorithm>
#include <cmath>

namespace regrasp::contour {
namespace {

/// Number of bisections of the largest possible square: to about 1e-12 of the perimeter.
constexpr int kHalvings = 40;

}  // namespace

SquareOracle::SquareOracle(const object::Polygon& polygon, double friction_angle)
    : polygon_(polygon), friction_angle_(friction_angle) {
  int edge = 0;
  for (const auto& ring : polygon.rings()) {
    first_edge_.push_back(edge);
    double perimeter = 0;
    for (std::size_t k = 0; k < ring.size(); ++k)
      perimeter += polygon.face_measure(FaceIndex(edge++));
    perimeter_.push_back(perimeter);
  }
  first_edge_.push_back(edge);
}

std::vector<grasp::Contact> SquareOracle::EndsWithin(int ring, double place,
                                                     double half_width) const {
  std::vector<grasp::Contact> ends;
  // One turn before and after the place suffice, because no square is wider than the ring is long.
  for (const int turn : {-1, 0, 1}) {
    double begin = turn * perimeter_[ring];
    for (int e = first_edge_[ring]; e < first_edge_[ring + 1]; ++e) {
      const double length = polygon_.face_measure(FaceIndex(e));
      const double low = std::max(begin, place - half_width);
      const double high = std::min(begin + length, place + half_width);
      if (low < high) {
        const auto [a, b] = polygon_.edge(FaceIndex(e));
        for (const double at : {low, high}) {
          const double share = (at - begin) / length;
          ends.push_back(
              {(1 - share) * a + share * b, polygon_.inward_normal(FaceIndex(e)), FaceIndex(e)});
        }
      }
      begin += length;
    }
  }
  return ends;
}

bool SquareOracle::Holds(int ring_a, double x, int ring_b, double y, double half_width) const {
  const std::vector<grasp::Contact> xs = EndsWithin(ring_a, x, half_width);
  const std::vector<grasp::Contact> ys = EndsWithin(ring_b, y, half_width);
  Sense common = Sense::kNone;
  for (const grasp::Contact& a : xs) {
    for (const grasp::Contact& b : ys) {
      if (a.face == b.face) return false;
      const Sense sense = SenseOf(polygon_, friction_angle_, a, b);
      if (sense != Sense::kSqueezing && sense != Sense::kStretching) return false;
      if (common == Sense::kNone) common = sense;
      if (sense != common) return false;
    }
  }
  return common != Sense::kNone;
}

double SquareOracle::SizeAt(int ring_a, double x, int ring_b, double y) const {
  double low = 0;
  double high = std::min(perimeter_[ring_a], perimeter_[ring_b]) / 2;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (Holds(ring_a, x, ring_b, y, middle) ? low : high) = middle;
  }
  return low;
}

double SquareOracle::SizeAt(const ContourGraph& graph, PieceIndex piece,
                            const Eigen::Vector2d& places) const {
  const auto& edges = graph.pieces()[piece].edges;
  return SizeAt(graph.boundary().ring_of(edges[0]), places.x(), graph.boundary().ring_of(edges[1]),
                places.y());
}

}  // namespace regrasp::contour
