#include "planner/collision/nearest_points.h"

#include <Eigen/QR>
#include <array>

#include "planner/collision/farthest.h"
#include "planner/collision/nearest_on_simplex.h"

namespace regrasp::collision {
namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

constexpr double kPointsConverged = 1e-9;  // of the distance
constexpr int kMostPointIterations = 100;
/// Nearer than this is no distance, metres.
constexpr double kMeet = 1e-12;

/// Corners of the difference a − b, each with the points that it is of.
struct PairSimplex {
  Simplex differences;
  std::array<NearestPair, 4> pairs;

  void Add(const NearestPair& pair) {
    pairs[differences.size] = pair;
    differences.points[differences.size++] = pair.on_a - pair.on_b;
  }
  /// As ReduceToNearest.
  Vector3d Reduce() {
    const PairSimplex before = *this;
    const Vector3d nearest = ReduceToNearest(differences);
    for (int i = 0; i < differences.size; ++i) {
      for (int k = 0; k < before.differences.size; ++k) {
        if (differences.points[i] == before.differences.points[k]) pairs[i] = before.pairs[k];
      }
    }
    return nearest;
  }
  /// The points whose difference is `nearest`, a point of the simplex's inside.
  [[nodiscard]] NearestPair PairAt(const Vector3d& nearest) const {
    const int others = differences.size - 1;
    const Vector3d& first = differences.points[0];
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> sides(3, others);
    for (int i = 0; i < others; ++i) sides.col(i) = differences.points[i + 1] - first;
    NearestPair pair = pairs[0];
    if (others == 0) return pair;
    const Eigen::VectorXd shares = sides.colPivHouseholderQr().solve(nearest - first);
    for (int i = 0; i < others; ++i) {
      pair.on_a += shares[i] * (pairs[i + 1].on_a - pairs[0].on_a);
      pair.on_b += shares[i] * (pairs[i + 1].on_b - pairs[0].on_b);
    }
    return pair;
  }
};

}  // namespace

std::optional<NearestPair> FindNearestPoints(Points a, Points b) {
  PairSimplex simplex;
  simplex.Add({a.front(), b.front()});
  Vector3d nearest = simplex.differences.points[0];
  for (int i = 0; i < kMostPointIterations; ++i) {
    const double distance = nearest.norm();
    if (distance <= kMeet) return std::nullopt;
    const NearestPair support = {Farthest(a, -nearest), Farthest(b, nearest)};
    // What is left to gain.
    const double gain = nearest.dot(nearest - (support.on_a - support.on_b));
    if (gain <= kPointsConverged * distance * distance) break;
    PairSimplex next = simplex;
    next.Add(support);
    const Vector3d nearer = next.Reduce();
    if (next.differences.size == 4) return std::nullopt;
    if (nearer.norm() >= distance) break;  // only rounding is left
    simplex = next;
    nearest = nearer;
  }
  return simplex.PairAt(nearest);
}

}  // namespace regrasp::collision
