#include "planner/object/polygon.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_triangulation_decomposition_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/box_intersection_d.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/body_measures.h"
#include "planner/object/segment.h"
#include "planner/object/weld.h"

namespace regrasp::object {

std::vector<std::array<int, 3>> TriangulatePolygon(const Polygon& polygon) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Polygon2 = CGAL::Polygon_2<Kernel>;
  std::vector<Polygon2> rings;
  std::map<Kernel::Point_2, int> index;
  for (const auto& ring : polygon.rings()) {
    Polygon2& out = rings.emplace_back();
    for (const Eigen::Vector2d& p : ring) {
      out.push_back({p.x(), p.y()});
      index.emplace(out.container().back(), static_cast<int>(index.size()));
    }
  }
  const CGAL::Polygon_with_holes_2<Kernel> region(rings.front(), rings.begin() + 1, rings.end());
  std::vector<Polygon2> pieces;
  CGAL::Polygon_triangulation_decomposition_2<Kernel>()(region, std::back_inserter(pieces));
  std::vector<std::array<int, 3>> triangles;
  for (Polygon2& piece : pieces) {
    if (piece.is_clockwise_oriented()) piece.reverse_orientation();
    triangles.push_back({index.at(piece[0]), index.at(piece[1]), index.at(piece[2])});
  }
  return triangles;
}

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Enlargement of query boxes divided by the diameter. It is far above rounding, so that only
/// distances decide.
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
  // As seen from above, the material is on the left of the edges, so a convex vertex turns left.
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
  if (!(mass.volume > 0)) throw InputError(name + ": ring 0: the area must be positive");
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
    // The box test rejects most edges.
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
  // An edge is convex, so a segment between two points near it is near it, too.
  return (ClosestPoint(face, a) - a).norm() <= tolerance &&
         (ClosestPoint(face, b) - b).norm() <= tolerance;
}

namespace {

using RingKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using RingPoint = RingKernel::Point_2;
using RingSegment = RingKernel::Segment_2;
using Ring = CGAL::Polygon_2<RingKernel>;

struct RingEdge {
  int ring = 0, index = 0, ring_size = 0;
  RingSegment segment;
};
using EdgeBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, const RingEdge*>;

std::string RingName(int ring) { return "ring " + std::to_string(ring); }

std::string VertexName(int ring, std::size_t vertex) {
  return RingName(ring) + ": vertex " + std::to_string(vertex);
}

std::string EdgeName(const RingEdge& edge) {
  return RingName(edge.ring) + ": edge " + std::to_string(edge.index);
}

void CheckPoints(const std::vector<Vector2d>& ring, int index, const std::string& name) {
  const auto fail = [&](std::size_t vertex, const std::string& what) {
    throw InputError(name + ": " + VertexName(index, vertex) + ": " + what);
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (const double x : ring[i]) {
      if (std::abs(x) <= kMaxCoordinate) continue;  // false for NaN
      fail(i, "the coordinate " + FormatDouble(x) + " must be finite and of magnitude at most " +
                  FormatDouble(kMaxCoordinate));
    }
  }
  std::vector<std::size_t> order(ring.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto coordinates = [&](std::size_t i) { return std::pair(ring[i].x(), ring[i].y()); };
  std::ranges::stable_sort(order, {}, coordinates);
  const auto twice = std::ranges::adjacent_find(order, {}, coordinates);
  if (twice != order.end()) {
    fail(*(twice + 1), "repeats vertex " + std::to_string(*twice) + " of its ring");
  }
  if (ring.size() < 3) {
    throw InputError(name + ": " + RingName(index) + ": expected at least 3 different points");
  }
}

std::vector<RingEdge> CollectEdges(const PolygonRings& rings) {
  std::vector<RingEdge> edges;
  for (int r = 0; r < std::ssize(rings); ++r) {
    const auto& ring = rings[r];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2d& a = ring[i];
      const Vector2d& b = ring[(i + 1) % ring.size()];
      edges.push_back({r, static_cast<int>(i), static_cast<int>(ring.size()),
                       RingSegment(RingPoint(a.x(), a.y()), RingPoint(b.x(), b.y()))});
    }
  }
  return edges;
}

bool Follows(const RingEdge& first, const RingEdge& second) {
  return first.ring == second.ring && (first.index + 1) % first.ring_size == second.index;
}

/// Return whether two edges share more than the vertex between consecutive edges.
bool MeetWrongly(const RingEdge& a, const RingEdge& b) {
  if (Follows(b, a)) return MeetWrongly(b, a);
  if (!Follows(a, b)) return CGAL::do_intersect(a.segment, b.segment);
  // Consecutive edges overlap only if the ring reverses its direction.
  const RingPoint &p = a.segment.source(), &q = a.segment.target(), &r = b.segment.target();
  return CGAL::collinear(p, q, r) && !CGAL::collinear_are_ordered_along_line(p, q, r);
}

void CheckCrossings(const PolygonRings& rings, const std::string& name) {
  const std::vector<RingEdge> edges = CollectEdges(rings);
  if (edges.size() > kMaxFacets) {
    throw InputError(name + ": " + std::to_string(edges.size()) + " edges, limit " +
                     std::to_string(kMaxFacets));
  }
  std::vector<EdgeBox> boxes;
  for (const RingEdge& edge : edges) boxes.emplace_back(edge.segment.bbox(), &edge);
  std::size_t overlaps = 0;
  CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const EdgeBox& one, const EdgeBox& other) {
        if (++overlaps > kMaxOverlaps) {
          throw InputError(name + ": too many nearby pairs of edges, expected at most " +
                           std::to_string(kMaxOverlaps));
        }
        if (!MeetWrongly(*one.info(), *other.info())) return;
        const auto [a, b] = std::minmax({one.info(), other.info()});  // pointers into one vector
        throw InputError(name + ": " + EdgeName(*a) + ": self-intersecting: meets " + EdgeName(*b));
      });
}

Ring ToRing(const std::vector<Vector2d>& points) {
  Ring ring;
  for (const auto& p : points) ring.push_back({p.x(), p.y()});
  return ring;
}

bool IsInside(const Ring& inner, const Ring& outer) {
  return outer.bounded_side(inner[0]) == CGAL::ON_BOUNDED_SIDE;
}

/// Check that holes are inside the outer ring and not in each other. Rings do not touch, so one
/// point of a ring decides for all of it.
void CheckNesting(const std::vector<Ring>& rings, const std::string& name) {
  for (std::size_t r = 1; r < rings.size(); ++r) {
    if (!IsInside(rings[r], rings[0])) {
      throw InputError(name + ": " + RingName(int(r)) + ": hole outside the outer ring");
    }
    for (std::size_t other = 1; other < rings.size(); ++other) {
      if (other == r || !CGAL::do_overlap(rings[r].bbox(), rings[other].bbox())) continue;
      if (IsInside(rings[r], rings[other])) {
        throw InputError(name + ": " + RingName(int(r)) + ": hole inside another hole, " +
                         RingName(int(other)));
      }
    }
  }
}

}  // namespace

void CheckAndOrientRings(PolygonRings& rings, const std::string& name) {
  if (rings.empty()) throw InputError(name + ": empty: expected at least one ring");
  for (int r = 0; r < std::ssize(rings); ++r) CheckPoints(rings[r], r, name);
  CheckCrossings(rings, name);
  std::vector<Ring> checked;
  for (const auto& ring : rings) checked.push_back(ToRing(ring));
  CheckNesting(checked, name);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (checked[r].is_counterclockwise_oriented() == (r == 0)) continue;
    std::reverse(rings[r].begin() + 1, rings[r].end());
  }
}

}  // namespace regrasp::object
