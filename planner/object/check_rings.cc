#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/polygon_rings.h"
#include "planner/object/size_limits.h"

namespace regrasp::object {

using Eigen::Vector2d;

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
      fail(i, "the coordinate " + FormatDouble(x) + " is not finite or beyond " +
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
    throw InputError(name + ": " + RingName(index) + ": fewer than three different points");
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

/// True iff two edges share more than the point where one follows the other.
bool MeetWrongly(const RingEdge& a, const RingEdge& b) {
  if (Follows(b, a)) return MeetWrongly(b, a);
  if (!Follows(a, b)) return CGAL::do_intersect(a.segment, b.segment);
  // Neighbours meet again only where the ring turns back onto itself.
  const RingPoint &p = a.segment.source(), &q = a.segment.target(), &r = b.segment.target();
  return CGAL::collinear(p, q, r) && !CGAL::collinear_are_ordered_along_line(p, q, r);
}

void CheckCrossings(const PolygonRings& rings, const std::string& name) {
  const std::vector<RingEdge> edges = CollectEdges(rings);
  if (edges.size() > kMaxFacets) {
    throw InputError(name + ": " + std::to_string(edges.size()) + " edges, more than " +
                     std::to_string(kMaxFacets));
  }
  std::vector<EdgeBox> boxes;
  for (const RingEdge& edge : edges) boxes.emplace_back(edge.segment.bbox(), &edge);
  std::size_t overlaps = 0;
  CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const EdgeBox& one, const EdgeBox& other) {
        if (++overlaps > kMaxOverlaps) {
          throw InputError(name + ": more than " + std::to_string(kMaxOverlaps) +
                           " pairs of edges lie so close that they would have to be checked");
        }
        if (!MeetWrongly(*one.info(), *other.info())) return;
        const auto [a, b] = std::minmax({one.info(), other.info()});  // one vector's addresses
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

/// Rings do not touch, so one point of a ring decides for all of it.
void CheckNesting(const std::vector<Ring>& rings, const std::string& name) {
  for (std::size_t r = 1; r < rings.size(); ++r) {
    if (!IsInside(rings[r], rings[0])) {
      throw InputError(name + ": " + RingName(int(r)) + ": a hole outside the outer ring");
    }
    for (std::size_t other = 1; other < rings.size(); ++other) {
      if (other == r || !CGAL::do_overlap(rings[r].bbox(), rings[other].bbox())) continue;
      if (IsInside(rings[r], rings[other])) {
        throw InputError(name + ": " + RingName(int(r)) + ": a hole inside " +
                         RingName(int(other)) + ", another hole");
      }
    }
  }
}

}  // namespace

void CheckAndOrientRings(PolygonRings& rings, const std::string& name) {
  if (rings.empty()) throw InputError(name + ": empty: no ring");
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
