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

using PlaneKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlaneSegment = PlaneKernel::Segment_2;

PlaneKernel::Point_2 ToPlanePoint(const Vector2d& p) { return {p.x(), p.y()}; }

Vector3d LiftToSpace(const Vector2d& p) { return {p.x(), p.y(), 0}; }

std::vector<Vector3d> AllPoints(const PolygonRings& rings) {
  std::vector<Vector3d> points;
  for (const auto& ring : rings) {
    for (const auto& p : ring) points.push_back(LiftToSpace(p));
  }
  return points;
}

void CheckRingEdges(const PolygonRings& rings, double diameter, const std::string& name) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Vector2d& next = rings[r][(i + 1) % rings[r].size()];
      const std::string complaint =
          EdgeComplaint(LiftToSpace(rings[r][i]), LiftToSpace(next), diameter);
      if (complaint.empty()) continue;
      throw InputError(name + ": ring " + std::to_string(r) + ": edge " + std::to_string(i) + ": " +
                       complaint);
    }
  }
}

std::vector<Face> MakeEdgeFaces(const PolygonRings& rings) {
  std::vector<Face> faces;
  for (const auto& ring : rings) {
    const int first = static_cast<int>(faces.size());
    const int size = static_cast<int>(ring.size());
    for (int i = 0; i < size; ++i) {
      const int next = (i + 1) % size;
      const Vector3d a = LiftToSpace(ring[i]), b = LiftToSpace(ring[next]);
      const Vector2d along = (ring[next] - ring[i]).stableNormalized();
      // Adding 0 turns −0 into +0: normals are printed.
      faces.push_back(
          {{-along.y() + 0.0, along.x() + 0.0, 0},
           (ring[next] - ring[i]).stableNorm(),
           {{a, a, FaceIndex(first + (i + size - 1) % size)}, {b, b, FaceIndex(first + next)}}});
    }
  }
  // Seen from above the material is on the left of the edges: a convex vertex turns left.
  const auto turns_left = [&](const Face& edge, const Face& next) {
    return IsConvexTurn(edge.inward_normal, next.inward_normal, Vector3d::UnitZ());
  };
  for (Face& edge : faces) {
    FaceBorder &start = edge.borders[0], &end = edge.borders[1];
    start.convex = turns_left(faces[start.beyond], edge);
    end.convex = turns_left(edge, faces[end.beyond]);
  }
  return faces;
}

}  // namespace

Polygon Polygon::FromRings(PolygonRings rings, const std::string& name) {
  CheckAndOrientRings(rings, name);
  const std::vector<Vector3d> points = AllPoints(rings);
  const double diameter = ComputeDiameter(points);
  if (const std::string complaint = SizeComplaint(points, diameter); !complaint.empty()) {
    throw InputError(name + ": vertices: " + complaint);
  }
  CheckRingEdges(rings, diameter, name);
  const MassProperties mass = ComputeMassProperties(rings);
  if (!(mass.volume > 0)) throw InputError(name + ": ring 0: no area");
  return Polygon(std::move(rings), diameter, mass);
}

Polygon Polygon::FromWkt(std::string_view text, const std::string& name) {
  return FromRings(ReadWktRings(text, name), name);
}

Polygon::Polygon(PolygonRings rings, double diameter, MassProperties mass_properties)
    : Object(2, MakeEdgeFaces(rings), diameter, std::move(mass_properties)),
      rings_(std::move(rings)) {
  for (FaceIndex face{0}; face < face_count(); ++face) {
    const std::vector<FaceBorder>& ends = BordersOf(face);
    edges_.emplace_back(ends[0].a.head<2>(), ends[1].a.head<2>());
  }
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
  const PlaneSegment segment(ToPlanePoint(a.head<2>()), ToPlanePoint(b.head<2>()));
  std::vector<FaceIndex> faces;
  for (FaceIndex face{0}; face < face_count(); ++face) {
    const auto& [from, to] = edges_[face];
    const double squared =
        CGAL::squared_distance(segment, PlaneSegment(ToPlanePoint(from), ToPlanePoint(to)));
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

}  // namespace regrasp::object
