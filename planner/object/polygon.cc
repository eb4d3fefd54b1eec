#include "planner/object/polygon.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/base/error.h"
#include "planner/object/closest_on_segment.h"
#include "planner/object/diameter.h"
#include "planner/object/polygon_rings.h"
#include "planner/object/size_limits.h"

namespace regrasp::object {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Boxes of edges are this much larger, over the diameter, than what is looked for: far above
/// roundings, so that distances decide alone.
constexpr double kBoxSlack = 1e-9;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Segment = Kernel::Segment_2;

Kernel::Point_2 ToPoint(const Vector2d& p) { return {p.x(), p.y()}; }

Vector3d InSpace(const Vector2d& p) { return {p.x(), p.y(), 0}; }

std::vector<Vector3d> AllPoints(const PolygonRings& rings) {
  std::vector<Vector3d> points;
  for (const auto& ring : rings) {
    for (const auto& p : ring) points.push_back(InSpace(p));
  }
  return points;
}

void CheckEdges(const PolygonRings& rings, double diameter, const std::string& name) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Vector2d& next = rings[r][(i + 1) % rings[r].size()];
      const std::string complaint = EdgeComplaint(InSpace(rings[r][i]), InSpace(next), diameter);
      if (complaint.empty()) continue;
      throw InputError(name + ": ring " + std::to_string(r) + ": edge " + std::to_string(i) + ": " +
                       complaint);
    }
  }
}

}  // namespace

Polygon Polygon::FromRings(PolygonRings rings, const std::string& name) {
  CheckAndOrientRings(rings, name);
  const std::vector<Vector3d> points = AllPoints(rings);
  const double diameter = ComputeDiameter(points);
  if (const std::string complaint = SizeComplaint(points, diameter); !complaint.empty()) {
    throw InputError(name + ": vertices: " + complaint);
  }
  CheckEdges(rings, diameter, name);
  const MassProperties mass = ComputeMassProperties(rings);
  if (!(mass.volume > 0)) throw InputError(name + ": ring 0: no area");
  return Polygon(std::move(rings), diameter, mass);
}

Polygon Polygon::FromWkt(std::string_view text, const std::string& name) {
  return FromRings(ReadWktRings(text, name), name);
}

Polygon::Polygon(PolygonRings rings, double diameter, MassProperties mass_properties)
    : Object(diameter, std::move(mass_properties)), rings_(std::move(rings)) {
  for (const auto& ring : rings_) {
    const int first = face_count();
    const int size = static_cast<int>(ring.size());
    for (int i = 0; i < size; ++i) {
      edges_.emplace_back(ring[i], ring[(i + 1) % size]);
      next_.emplace_back(first + (i + 1) % size);
      previous_.emplace_back(first + (i + size - 1) % size);
    }
  }
}

std::pair<Vector3d, Vector3d> Polygon::edge(FaceIndex face) const {
  return {InSpace(edges_[face].first), InSpace(edges_[face].second)};
}

Vector3d Polygon::inward_normal(FaceIndex face) const {
  const Vector2d along = (edges_[face].second - edges_[face].first).stableNormalized();
  // Adding 0 turns −0 into +0: normals are printed.
  return {-along.y() + 0.0, along.x() + 0.0, 0};
}

double Polygon::face_measure(FaceIndex face) const {
  return (edges_[face].second - edges_[face].first).stableNorm();
}

Vector3d Polygon::ClosestPoint(FaceIndex face, const Vector3d& point) const {
  const auto [a, b] = edge(face);
  return ClosestOnSegment(a, b, point);
}

std::vector<FaceIndex> Polygon::FacesNear(const Vector3d& point, double tolerance) const {
  const Eigen::Array2d reach = Eigen::Array2d::Constant(tolerance + kBoxSlack * diameter());
  const Eigen::Array2d low = point.head<2>().array() - reach;
  const Eigen::Array2d high = point.head<2>().array() + reach;
  std::vector<std::pair<double, FaceIndex>> near;
  for (FaceIndex face{0}; face < face_count(); ++face) {
    // Of most edges their box tells that they are too far.
    const auto& [a, b] = edges_[face];
    if ((a.cwiseMax(b).array() < low).any() || (a.cwiseMin(b).array() > high).any()) continue;
    const double distance = (ClosestPoint(face, point) - point).norm();
    if (distance <= tolerance) near.emplace_back(distance, face);
  }
  std::ranges::sort(near);
  std::vector<FaceIndex> faces;
  for (const auto& [distance, face] : near) faces.push_back(face);
  return faces;
}

std::vector<FaceIndex> Polygon::FacesNearSegment(const Vector3d& a, const Vector3d& b,
                                                 double tolerance) const {
  const Segment segment(ToPoint(a.head<2>()), ToPoint(b.head<2>()));
  std::vector<FaceIndex> faces;
  for (FaceIndex face{0}; face < face_count(); ++face) {
    const auto& [from, to] = edges_[face];
    const double squared = CGAL::squared_distance(segment, Segment(ToPoint(from), ToPoint(to)));
    if (std::sqrt(squared) <= tolerance) faces.push_back(face);
  }
  return faces;
}

double Polygon::DistanceToBorder(FaceIndex face, const Vector3d& point) const {
  const auto [a, b] = edge(face);
  return std::min((point - a).norm(), (point - b).norm());
}

bool Polygon::ContainsSegment(FaceIndex face, const Vector3d& a, const Vector3d& b,
                              double tolerance) const {
  // An edge is convex: what lies between two points near it is near it too.
  return (ClosestPoint(face, a) - a).norm() <= tolerance &&
         (ClosestPoint(face, b) - b).norm() <= tolerance;
}

std::vector<FaceBorder> Polygon::BordersOf(FaceIndex face) const {
  // Seen from above the material is on the left of the edges: a convex vertex turns left.
  const auto convex = [&](FaceIndex edge, FaceIndex next) {
    return IsConvexTurn(inward_normal(edge), inward_normal(next), Vector3d::UnitZ());
  };
  const auto [a, b] = edge(face);
  const FaceIndex before = previous_[face];
  const FaceIndex after = next_[face];
  return {{a, a, before, convex(before, face)}, {b, b, after, convex(face, after)}};
}

bool Polygon::AreNeighbours(FaceIndex face, FaceIndex other) const {
  return other == next_[face] || other == previous_[face];
}

std::vector<Vector3d> Polygon::CommonPoints(FaceIndex face, FaceIndex other, const Vector3d& point,
                                            double tolerance) const {
  std::vector<Vector3d> points;
  for (const FaceBorder& border : BordersOf(face)) {
    if (border.beyond == other && (border.a - point).norm() <= tolerance) {
      points.push_back(border.a);
    }
  }
  return points;
}

}  // namespace regrasp::object
