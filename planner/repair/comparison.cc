#include "planner/repair/comparison.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "planner/object/facet_triangulation.h"
#include "planner/repair/cgal_mesh.h"

namespace regrasp::repair {

using Eigen::Vector3d;
using object::PolygonSoup;

namespace {

constexpr int kSamples = 20000;

/// Number of points for visibility tests and wall thickness.
constexpr int kSeenSamples = 3000;

/// Increments of a low-discrepancy sequence in the unit square: 1/p and 1/p² with p³ = p + 1
/// (Roberts 2018).
constexpr double kStepU = 0.7548776662466927, kStepV = 0.5698402909980532;

/// Offset of the origin of a ray from the surface, over the diameter.
constexpr double kOff = 1e-6;

/// Number of directions of the visibility test.
constexpr int kDirections = 64;

/// Number of unobstructed directions that make a point visible. Fewer can pass through a crack
/// between two pieces.
constexpr int kSeenBy = 3;

/// Accuracy of the upper bound over the diameter. The bound is looser if it needs more than
/// kMostPieces pieces of triangles.
constexpr double kBoundAccuracy = 1e-3;
constexpr int kMostPieces = 400'000;

/// Largest radius, over the diameter, of the triangle pieces tested for filled surface.
constexpr double kFilledStep = 0.01;

using Triangle = std::array<Vector3d, 3>;

Triangle TriangleOf(const PolygonSoup& soup, std::size_t facet) {
  const auto& f = soup.facets[facet];
  return {soup.vertices[f[0]], soup.vertices[f[1]], soup.vertices[f[2]]};
}

Vector3d AreaVector(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]) / 2; }

Vector3d Centre(const Triangle& t) { return (t[0] + t[1] + t[2]) / 3; }

double Radius(const Triangle& t) {
  const Vector3d centre = Centre(t);
  return std::max({(t[0] - centre).norm(), (t[1] - centre).norm(), (t[2] - centre).norm()});
}

/// Bisect a triangle across its longest edge.
/// Slivers then need a number of pieces proportional to their length, not to its square.
std::array<Triangle, 2> Halves(const Triangle& t) {
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge = (t[(k + 1) % 3] - t[k]).squaredNorm();
    if (edge > length) length = edge, longest = k;
  }
  const Vector3d &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
  const Vector3d middle = (a + b) / 2;
  return {Triangle{a, middle, c}, Triangle{middle, b, c}};
}

struct Sample {
  Vector3d point;
  Vector3d normal;  ///< unit vector; outward if the triangle is oriented
};

/// Sample points evenly over the area: one from each of `count` parts of equal area.
std::vector<Sample> DrawSamples(const PolygonSoup& soup, int count) {
  std::vector<double> up_to;
  double area = 0;
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    up_to.push_back(area += AreaVector(TriangleOf(soup, f)).norm());
  }
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const double at = (i + 0.5) / count * area;
    const auto found = std::ranges::upper_bound(up_to, at);
    const auto facet = std::min<std::ptrdiff_t>(found - up_to.begin(), std::ssize(up_to) - 1);
    const Triangle t = TriangleOf(soup, static_cast<std::size_t>(facet));
    double u = std::fmod((i + 1) * kStepU, 1), v = std::fmod((i + 1) * kStepV, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    samples.push_back(
        {t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]), AreaVector(t).stableNormalized()});
  }
  return samples;
}

/// Return the 95th percentile.
double NinetyFifth(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto nth = values.begin() + std::ptrdiff_t(0.95 * double(values.size() - 1));
  std::ranges::nth_element(values, nth);
  return *nth;
}

double Mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// Return an upper bound of the distance of a triangle's points to a surface.
/// `nearest` is the surface point nearest to the centroid. The bound uses two facts: the distance
/// to a surface is 1-Lipschitz, and the distance to a convex set, such as one triangle, is largest
/// at a corner.
double FarthestOf(const Triangle& t, const SurfaceDistance& surface,
                  const SurfaceDistance::Closest& nearest) {
  double at_corners = 0;
  for (const Vector3d& corner : t) {
    at_corners = std::max(at_corners, surface.DistanceTo(corner, nearest));
  }
  return std::min(at_corners, (nearest.point - Centre(t)).norm() + Radius(t));
}

/// Return an upper bound of the largest distance from `from` to `to`.
/// Best-first search: the piece with the largest bound is bisected until its bound is within
/// `accuracy` of the largest distance found.
double BoundDistance(const PolygonSoup& from, const SurfaceDistance& to, double least,
                     double accuracy) {
  struct Piece {
    double bound;
    Triangle triangle;
    SurfaceDistance::Closest closest;  ///< nearest point to the centroid
    bool operator<(const Piece& other) const { return bound < other.bound; }
  };
  std::priority_queue<Piece> pieces;
  double largest = least;
  int examined = 0;
  std::optional<SurfaceDistance::Closest> near;
  const auto examine = [&](const Triangle& t) {
    ++examined;
    const Vector3d centre = Centre(t);
    near = to.FindClosest(centre, near);
    largest = std::max(largest, (near->point - centre).norm());
    const double bound = FarthestOf(t, to, *near);
    if (bound > largest + accuracy) pieces.push({bound, t, *near});
  };
  for (std::size_t f = 0; f < from.facets.size(); ++f) examine(TriangleOf(from, f));
  while (!pieces.empty() && pieces.top().bound > largest + accuracy) {
    if (examined > kMostPieces) return pieces.top().bound;
    const Triangle t = pieces.top().triangle;
    near = pieces.top().closest;
    pieces.pop();
    for (const Triangle& half : Halves(t)) examine(half);
  }
  return largest + accuracy;
}

DistanceSummary Summarize(const PolygonSoup& from, const std::vector<Sample>& samples,
                          const std::vector<double>& distances, const SurfaceDistance& to,
                          double diameter) {
  DistanceSummary summary;
  summary.mean = Mean(distances);
  summary.most = NinetyFifth(distances);
  const auto farthest = std::ranges::max_element(distances);
  summary.largest = *farthest;
  summary.where = samples[static_cast<std::size_t>(farthest - distances.begin())].point;
  summary.bound = BoundDistance(from, to, summary.largest, kBoundAccuracy * diameter);
  return summary;
}

/// Return unit vectors spread evenly over the sphere (Fibonacci spiral).
std::vector<Vector3d> MakeDirections() {
  std::vector<Vector3d> directions;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * i + 1.0) / kDirections;
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return directions;
}

bool IsSeen(const Sample& sample, const SurfaceDistance& surface,
            const std::vector<Vector3d>& directions, double off) {
  int free = 0;
  for (const Vector3d& d : directions) {
    const double side = sample.normal.dot(d) >= 0 ? 1 : -1;
    free += !surface.IsHit(sample.point + side * off * sample.normal, d);
    if (free == kSeenBy) return true;
  }
  return false;
}

void CompareSeen(const PolygonSoup& solid, const std::vector<Sample>& samples,
                 const SurfaceDistance& to_original, const SurfaceDistance& to_solid, double off,
                 Comparison& comparison) {
  const std::vector<Vector3d> directions = MakeDirections();
  std::vector<double> distances, angles;
  for (const Sample& sample : samples) {
    if (!IsSeen(sample, to_original, directions, off)) continue;
    const SurfaceDistance::Closest closest = to_solid.FindClosest(sample.point);
    distances.push_back((closest.point - sample.point).norm());
    const Vector3d normal =
        AreaVector(TriangleOf(solid, static_cast<std::size_t>(closest.facet))).stableNormalized();
    // The absolute value makes the angle independent of the original's orientation, which can be
    // unknown.
    angles.push_back(std::acos(std::min(1.0, std::abs(normal.dot(sample.normal)))));
  }
  comparison.seen_share = double(distances.size()) / double(samples.size());
  comparison.seen_most = NinetyFifth(distances);
  comparison.normal_mean = Mean(angles);
  comparison.normal_most = NinetyFifth(angles);
}

/// Return true iff a tested point of a triangle is farther than `distance` from a surface.
/// @param near  input: result for a nearby point, a hint. Output: result for a point of the
///     triangle.
bool ReachesBeyond(const Triangle& t, const SurfaceDistance& surface, double distance, double step,
                   std::optional<SurfaceDistance::Closest>& near) {
  near = surface.FindClosest(Centre(t), near);
  if ((near->point - Centre(t)).norm() > distance) return true;
  if (Radius(t) <= step || FarthestOf(t, surface, *near) <= distance) return false;
  return std::ranges::any_of(Halves(t), [&](const Triangle& half) {
    return ReachesBeyond(half, surface, distance, step, near);
  });
}

void FindFilled(const PolygonSoup& solid, const SurfaceDistance& to_original, double diameter,
                Comparison& comparison) {
  double area = 0, filled = 0;
  std::optional<SurfaceDistance::Closest> near;
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    const Triangle t = TriangleOf(solid, f);
    const bool is_filled =
        ReachesBeyond(t, to_original, kFilledDistance * diameter, kFilledStep * diameter, near);
    comparison.filled.push_back(is_filled);
    area += AreaVector(t).norm();
    if (is_filled) filled += AreaVector(t).norm();
  }
  comparison.filled_share = filled / area;
}

double ThinShare(const std::vector<Sample>& samples, const SurfaceDistance& solid,
                 double diameter) {
  const auto thin = std::ranges::count_if(samples, [&](const Sample& sample) {
    const Vector3d start = sample.point - kOff * diameter * sample.normal;
    return solid.FirstHit(start, -sample.normal) < kThinWall * diameter;
  });
  return double(thin) / double(samples.size());
}

std::vector<double> Distances(const std::vector<Sample>& samples, const SurfaceDistance& to) {
  std::vector<double> distances;
  std::optional<SurfaceDistance::Closest> near;  // consecutive samples are on the same triangle
  for (const Sample& sample : samples) {
    near = to.FindClosest(sample.point, near);
    distances.push_back((near->point - sample.point).norm());
  }
  return distances;
}

}  // namespace

PolygonSoup OriginalOfPart(const PolygonSoup& original, const PolygonSoup& all,
                           const PolygonSoup& part) {
  /// Relative tolerance for rounded coordinates. Triangles equally near to both belong to the part.
  constexpr double kSame = 1e-9;
  const SurfaceDistance to_all(all), to_part(part);
  PolygonSoup its{original.vertices, {}};
  for (std::size_t f = 0; f < original.facets.size(); ++f) {
    const Vector3d centre = Centre(TriangleOf(original, f));
    if (to_part.DistanceTo(centre) <= to_all.DistanceTo(centre) * (1 + kSame)) {
      its.facets.push_back(original.facets[f]);
    }
  }
  return its;
}

Comparison Compare(const PolygonSoup& original, const PolygonSoup& solid, double diameter) {
  const SurfaceDistance to_original(original), to_solid(solid);
  Comparison comparison;
  const std::vector<Sample> old_samples = DrawSamples(original, kSamples);
  comparison.to_solid =
      Summarize(original, old_samples, Distances(old_samples, to_solid), to_solid, diameter);
  const std::vector<Sample> new_samples = DrawSamples(solid, kSamples);
  comparison.to_original =
      Summarize(solid, new_samples, Distances(new_samples, to_original), to_original, diameter);
  CompareSeen(solid, DrawSamples(original, kSeenSamples), to_original, to_solid, kOff * diameter,
              comparison);
  FindFilled(solid, to_original, diameter, comparison);
  comparison.thin_share = ThinShare(DrawSamples(solid, kSeenSamples), to_solid, diameter);
  return comparison;
}

using Eigen::Vector3d;
using object::PolygonSoup;

namespace {

bool IsMarked(const PolygonSoup& soup, std::size_t facet) {
  return !soup.filled.empty() && soup.filled[facet];
}

bool HasMarks(const PolygonSoup& soup) {
  return std::ranges::find(soup.filled, true) != soup.filled.end();
}

/// Return the marked polygons, or the unmarked ones, as triangles.
PolygonSoup TrianglesOf(const PolygonSoup& soup, bool marked) {
  PolygonSoup triangles{soup.vertices, {}};
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    const std::vector<int>& facet = soup.facets[f];
    if (IsMarked(soup, f) != marked || facet.size() < 3) continue;
    std::vector<Vector3d> corners;
    for (const int v : facet) corners.push_back(soup.vertices[v]);
    for (const auto& [a, b, c] : object::CutPolygon(corners).triangles) {
      triangles.facets.push_back({facet[a], facet[b], facet[c]});
    }
  }
  return triangles;
}

/// Return the tested points of a triangle: its centroid, and the midpoints between centroid and
/// corners.
std::array<Vector3d, 4> CornersOf(const PolygonSoup& solid, std::size_t facet) {
  const auto& f = solid.facets[facet];
  const Vector3d &a = solid.vertices[f[0]], &b = solid.vertices[f[1]], &c = solid.vertices[f[2]];
  const Vector3d centre = (a + b + c) / 3;
  return {centre, (centre + a) / 2, (centre + b) / 2, (centre + c) / 2};
}

double AreaOf(const PolygonSoup& triangles) {
  double area = 0;
  for (const auto& f : triangles.facets) {
    const Vector3d& a = triangles.vertices[f[0]];
    area += (triangles.vertices[f[1]] - a).cross(triangles.vertices[f[2]] - a).norm() / 2;
  }
  return area;
}

/// Mark triangles that are nearer to the original's filled surface than to its other surface.
void InheritMarks(const PolygonSoup& original, PolygonSoup& solid) {
  const PolygonSoup filled = TrianglesOf(original, true), known = TrianglesOf(original, false);
  if (filled.facets.empty()) return;
  if (known.facets.empty()) {
    solid.filled.assign(solid.facets.size(), true);
    return;
  }
  const SurfaceDistance to_filled(filled), to_known(known);
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    const std::array<Vector3d, 4> points = CornersOf(solid, f);
    if (std::ranges::any_of(points, [&](const Vector3d& p) {
          return to_filled.DistanceTo(p) < to_known.DistanceTo(p);
        })) {
      solid.filled[f] = true;
    }
  }
}

}  // namespace

void MarkFilled(const PolygonSoup& original, const Comparison& comparison, PolygonSoup& solid) {
  solid.filled = comparison.filled;
  solid.filled.resize(solid.facets.size(), false);
  if (HasMarks(original)) InheritMarks(original, solid);
}

double FilledShare(const PolygonSoup& solid) {
  const double filled = AreaOf(TrianglesOf(solid, true));
  return filled / (filled + AreaOf(TrianglesOf(solid, false)));
}

void FilledLast(PolygonSoup& solid) {
  if (!HasMarks(solid)) solid.filled.clear();
  PolygonSoup sorted{solid.vertices, {}};
  for (const bool filled : {false, true}) {
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
      if (IsMarked(solid, f) != filled) continue;
      sorted.facets.push_back(solid.facets[f]);
      if (!solid.filled.empty()) sorted.filled.push_back(filled);
    }
  }
  solid = std::move(sorted);
}

}  // namespace regrasp::repair
