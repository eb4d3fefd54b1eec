#include "planner/collision/convex_shape.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace regrasp::collision {

using Eigen::Vector3d;

ConvexShape Moved(const Eigen::Isometry3d& pose, const ConvexShape& shape) {
  ConvexShape moved = shape;
  for (Vector3d& point : moved.points) point = pose * point;
  return moved;
}

PosedShape Moved(const Eigen::Isometry3d& motion, const PosedShape& posed) {
  return {posed.shape, motion * posed.pose, {motion * posed.sphere.centre, posed.sphere.radius}};
}

ConvexShape Enclosing(const ConvexShape& shape, double tolerance) {
  ConvexShape enclosing;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d& end = Farthest(shape.points, sign * Vector3d::Unit(axis));
      if (std::ranges::find(enclosing.points, end) == enclosing.points.end()) {
        enclosing.points.push_back(end);
      }
    }
  }
  // Distances of points from the hull when it had fewer points, which are upper bounds.
  struct Bound {
    double distance;
    std::size_t point;
    auto operator<=>(const Bound&) const = default;
  };
  std::vector<Bound> bounds;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    bounds.push_back({std::numeric_limits<double>::infinity(), i});
  }
  std::priority_queue<Bound> farthest(std::less<Bound>(), std::move(bounds));
  while (farthest.top().distance > tolerance) {
    const Bound before = farthest.top();
    farthest.pop();
    const Vector3d& point = shape.points[before.point];
    const double distance = Distance({{point}, 0}, enclosing).upper;
    const bool is_farthest = farthest.empty() || distance >= farthest.top().distance;
    if (distance > tolerance && is_farthest) {
      enclosing.points.push_back(point);
    } else {
      farthest.push({distance, before.point});
    }
  }
  enclosing.radius = shape.radius + farthest.top().distance;
  return enclosing;
}

BoundingSphere BoundingSphereOf(const ConvexShape& shape) {
  Vector3d lower = shape.points.front();
  Vector3d upper = lower;
  for (const Vector3d& point : shape.points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  BoundingSphere ball{(lower + upper) / 2, 0};
  for (const Vector3d& point : shape.points) {
    ball.radius = std::max(ball.radius, (point - ball.centre).norm());
  }
  ball.radius += shape.radius;
  return ball;
}

DistanceBounds Distance(const ConvexShape& a, const ConvexShape& b) {
  const DistanceBounds hulls = HullDistance(a.points, b.points);
  const double radii = a.radius + b.radius;
  return {std::max(0.0, hulls.lower - radii), std::max(0.0, hulls.upper - radii)};
}

bool AreApart(const ConvexShape& a, const ConvexShape& b, double distance) {
  const double enough = distance + a.radius + b.radius;
  return HullDistance(a.points, b.points, enough).lower > enough;
}

namespace {

using Eigen::Vector3d;

/// The nearest point of a face of a simplex, and the corners that the point needs.
struct Nearest {
  Vector3d point = Vector3d::Zero();
  HullSimplex needed;
  double square = std::numeric_limits<double>::infinity();
};

void TakeIfNearer(const Nearest& other, Nearest& best) {
  if (other.square < best.square) best = other;
}

Nearest NearestOfPoint(const Vector3d& a) {
  Nearest nearest;
  nearest.point = a;
  nearest.needed.points[0] = a;
  nearest.needed.size = 1;
  nearest.square = a.squaredNorm();
  return nearest;
}

Nearest NearestOfSegment(const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double t = -a.dot(along);
  const double length = along.squaredNorm();
  if (t <= 0 || length == 0) return NearestOfPoint(a);
  if (t >= length) return NearestOfPoint(b);
  Nearest nearest;
  nearest.point = a + (t / length) * along;
  nearest.needed.points = {a, b};
  nearest.needed.size = 2;
  nearest.square = nearest.point.squaredNorm();
  return nearest;
}

Nearest NearestOfTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  // Barycentric coordinates of the origin's projection, times `square`.
  const double at_a = b.cross(c).dot(normal);
  const double at_b = c.cross(a).dot(normal);
  const double at_c = a.cross(b).dot(normal);
  if (square > 0 && at_a > 0 && at_b > 0 && at_c > 0) {
    Nearest nearest;
    nearest.point = (a.dot(normal) / square) * normal;
    nearest.needed.points = {a, b, c};
    nearest.needed.size = 3;
    nearest.square = nearest.point.squaredNorm();
    return nearest;
  }
  Nearest best = NearestOfSegment(a, b);
  TakeIfNearer(NearestOfSegment(b, c), best);
  TakeIfNearer(NearestOfSegment(c, a), best);
  return best;
}

/// Return whether the origin and `d` are on the same side of the plane of a, b and c, or one is on
/// it.
bool IsOnSideOf(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d normal = (b - a).cross(c - a);
  return normal.dot(-a) * normal.dot(d - a) >= 0;
}

Nearest NearestOfTetrahedron(const HullSimplex& simplex) {
  const auto& [a, b, c, d] = simplex.points;
  const double volume = (b - a).cross(c - a).dot(d - a);
  const bool flat = volume == 0;
  Nearest best;
  bool inside = !flat;
  const auto try_face = [&](const Vector3d& p, const Vector3d& q, const Vector3d& r,
                            const Vector3d& opposite) {
    if (!flat && IsOnSideOf(p, q, r, opposite)) return;
    inside = false;
    TakeIfNearer(NearestOfTriangle(p, q, r), best);
  };
  try_face(a, b, c, d);
  try_face(a, c, d, b);
  try_face(a, b, d, c);
  try_face(b, c, d, a);
  if (!inside) return best;
  best.needed = simplex;
  best.square = 0;
  return best;
}

}  // namespace

Vector3d ReduceToNearest(HullSimplex& simplex) {
  const auto& points = simplex.points;
  Nearest nearest;
  switch (simplex.size) {
    case 1:
      nearest = NearestOfPoint(points[0]);
      break;
    case 2:
      nearest = NearestOfSegment(points[0], points[1]);
      break;
    case 3:
      nearest = NearestOfTriangle(points[0], points[1], points[2]);
      break;
    default:
      nearest = NearestOfTetrahedron(simplex);
      break;
  }
  simplex = nearest.needed;
  return nearest.point;
}

namespace {

using Points = std::span<const Vector3d>;

constexpr double kPointsConverged = 1e-9;  // relative to the distance
constexpr int kMostPointIterations = 100;
/// Rounding error of differences and products, relative to the size of the points.
constexpr double kMeet = 1e-12;

/// Simplex of the difference a − b, with the pair of points of each corner.
struct PairSimplex {
  HullSimplex differences;
  std::array<NearestPair, 4> pairs;

  void Add(const NearestPair& pair) {
    pairs[differences.size] = pair;
    differences.points[differences.size++] = pair.on_a - pair.on_b;
  }
  /// Reduce the simplex as ReduceToNearest.
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
  /// Return the pair of points whose difference is `nearest`, a point inside the simplex.
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

/// @param a  anything with a function Farthest. @param first  a point of it.
template <typename Hull>
std::optional<NearestPair> NearestOfHulls(const Hull& a, const Vector3d& first, Points b,
                                          double most) {
  PairSimplex simplex;
  simplex.Add({first, b.front()});
  Vector3d nearest = simplex.differences.points[0];
  for (int i = 0; i < kMostPointIterations; ++i) {
    const double distance = nearest.norm();
    if (distance <= kMeet) return std::nullopt;
    const NearestPair support = {Farthest(a, -nearest), Farthest(b, nearest)};
    const Vector3d difference = support.on_a - support.on_b;
    if (nearest.dot(difference) > most * distance) break;
    // Upper bound on the square of the distance minus its final value.
    const double gain = nearest.dot(nearest - difference);
    if (gain <= kPointsConverged * distance * distance) break;
    PairSimplex next = simplex;
    next.Add(support);
    const Vector3d nearer = next.Reduce();
    if (next.differences.size == 4) return std::nullopt;
    if (nearer.norm() >= distance) break;  // rounding prevents any gain
    simplex = next;
    nearest = nearer;
  }
  return simplex.PairAt(nearest);
}

}  // namespace

std::optional<NearestPair> FindNearestPoints(Points a, Points b) {
  return NearestOfHulls(a, a.front(), b, std::numeric_limits<double>::infinity());
}

std::optional<NearestPair> FindNearestPoints(const PointTree& a, Points b, double most) {
  return NearestOfHulls(a, a.points().front(), b, most);
}

PointTree::PointTree(std::vector<Vector3d> points) : points_(std::move(points)) {
  Build(0, static_cast<int>(points_.size()));
}

void PointTree::Build(int begin, int end) {
  const std::size_t index = nodes_.size();
  const auto first = points_.begin();
  nodes_.push_back({begin, end, 0, BoundingSphereOf({{first + begin, first + end}, 0})});
  if (end - begin <= kLeaf) return;
  Eigen::AlignedBox3d box;
  for (int i = begin; i < end; ++i) box.extend(points_[i]);
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(first + begin, first + middle, first + end,
                   [axis](const Vector3d& a, const Vector3d& b) { return a[axis] < b[axis]; });
  Build(begin, middle);
  nodes_[index].right = static_cast<int>(nodes_.size());
  Build(middle, end);
}

void PointTree::Move(const Eigen::Isometry3d& pose) {
  for (Vector3d& point : points_) point = pose * point;
  for (Node& node : nodes_) node.sphere.centre = pose * node.sphere.centre;
}

namespace {

/// The farthest point found so far in a direction.
struct FarthestSearch {
  const PointTree& tree;
  const Vector3d& direction;
  double length;
  const Vector3d* best;
  double most;

  /// Return the upper bound of a node.
  [[nodiscard]] double Bound(int node) const {
    const BoundingSphere& sphere = tree.nodes()[node].sphere;
    return sphere.centre.dot(direction) + sphere.radius * length;
  }
  void Visit(int index) {
    const PointTree::Node& node = tree.nodes()[index];
    if (node.right != 0) {
      int near = index + 1;
      int far = node.right;
      double near_bound = Bound(near);
      double far_bound = Bound(far);
      if (far_bound > near_bound) {
        std::swap(near, far);
        std::swap(near_bound, far_bound);
      }
      if (near_bound > most) Visit(near);
      if (far_bound > most) Visit(far);
      return;
    }
    const Vector3d& point = Farthest(tree.PointsOf(node), direction);
    const double reached = point.dot(direction);
    if (reached > most) {
      most = reached;
      best = &point;
    }
  }
};

}  // namespace

const Vector3d& Farthest(const PointTree& tree, const Vector3d& direction) {
  const Vector3d* first = tree.points().data();
  FarthestSearch search{tree, direction, direction.norm(), first, first->dot(direction)};
  search.Visit(0);
  return *search.best;
}

namespace {

constexpr double kConverged = 1e-9;  // relative to the distance
constexpr int kMostIterations = 100;
/// Rounding error of differences and products, relative to the size of the points.
constexpr double kRounding = 1e-14;

double SizeOf(Points points) {
  double size = 0;
  for (const Vector3d& point : points) size = std::max(size, point.lpNorm<1>());
  return size;
}

/// Points at a pose.
struct PosedPoints {
  Points points;
  const Eigen::Isometry3d& pose;
};

using collision::Farthest;

Vector3d Farthest(const PosedPoints& posed, const Vector3d& direction) {
  const Vector3d turned = posed.pose.linear().transpose() * direction;
  return posed.pose * Farthest(posed.points, turned);
}

/// Compute HullDistance.
/// @param nearest  point of the difference a − b at which the search begins.
/// @param slack    bound on the rounding error of distances.
template <typename Hull>
HullBounds DistanceFrom(Vector3d nearest, Points a, const Hull& b, double slack,
                        std::optional<double> decided) {
  HullBounds bounds;
  HullSimplex simplex;
  // Search for the point of the difference a − b nearest to the origin.
  simplex.points[0] = nearest;
  simplex.size = 1;
  bounds.upper = nearest.norm();
  for (int i = 0; i < kMostIterations; ++i) {
    if (bounds.upper <= slack) return {{0, bounds.upper}};
    const Vector3d support = Farthest(a, -nearest) - Farthest(b, nearest);
    const double lower = support.dot(nearest) / bounds.upper - slack;
    if (lower > bounds.lower) {
      bounds.lower = lower;
      bounds.direction = nearest;
    }
    if (decided && (bounds.lower > *decided || bounds.upper <= *decided)) return bounds;
    if (bounds.upper - bounds.lower <= kConverged * bounds.upper + slack) return bounds;
    simplex.points[simplex.size++] = support;
    nearest = ReduceToNearest(simplex);
    if (simplex.size == 4) return {};
    const double upper = nearest.norm();
    // The remaining difference is rounding error.
    if (upper >= bounds.upper) return bounds;
    bounds.upper = upper;
  }
  return bounds;
}

}  // namespace

HullBounds HullDistance(Points a, Points b, std::optional<double> decided) {
  const double slack = kRounding * (SizeOf(a) + SizeOf(b));
  return DistanceFrom(a.front() - b.front(), a, b, slack, decided);
}

bool AreApart(const PosedShape& a, const PosedShape& b, double distance) {
  const Vector3d between = a.sphere.centre - b.sphere.centre;
  const double radii = a.sphere.radius + b.sphere.radius;
  const double far = radii + distance;
  if (between.squaredNorm() > far * far) return true;
  // In the frame of `a`, only points of `b` that matter are moved.
  const Eigen::Isometry3d to_a = a.pose.inverse();
  const Eigen::Isometry3d b_to_a = to_a * b.pose;
  const Vector3d direction = to_a.linear() * between;
  const double size = (to_a * a.sphere.centre).norm() + direction.norm() + radii;
  // SizeOf has the 1-norm, which is at most √3 times as large; 4 allows for moving points of `b`.
  const double slack = 4 * kRounding * std::numbers::sqrt3 * size;
  const double enough = distance + a.shape->radius + b.shape->radius;
  const PosedPoints of_b{b.shape->points, b_to_a};
  const Vector3d support = Farthest(a.shape->points, -direction) - Farthest(of_b, direction);
  if (support.dot(direction) > (enough + slack) * direction.norm()) return true;
  return DistanceFrom(support, a.shape->points, of_b, slack, enough).lower > enough;
}

bool AreApartAlong(Points a, Points b, const Vector3d& direction, double distance) {
  const double length = direction.norm();
  if (!(length > 0)) return false;
  const double slack = kRounding * (SizeOf(a) + SizeOf(b));
  const Vector3d gap = Farthest(a, -direction) - Farthest(b, direction);
  return gap.dot(direction) / length - slack > distance;
}

}  // namespace regrasp::collision
