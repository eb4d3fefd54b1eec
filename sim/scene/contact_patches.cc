#include "sim/scene/contact_patches.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Iso_rectangle_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/variant/get.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/object/segment.h"

namespace regrasp::sim {

namespace {

VisibleSurface MakePrism(const object::Polygon& polygon, double thickness) {
  VisibleSurface prism;
  // Vertex k of the polygon is 2 k below and 2 k + 1 above.
  for (const auto& ring : polygon.rings()) {
    const int first = static_cast<int>(prism.vertices.size());
    const int count = static_cast<int>(ring.size());
    for (int k = 0; k < count; ++k) {
      prism.vertices.emplace_back(ring[k].x(), ring[k].y(), -thickness / 2);
      prism.vertices.emplace_back(ring[k].x(), ring[k].y(), thickness / 2);
      const int a = first + 2 * k;
      const int b = first + 2 * ((k + 1) % count);
      prism.triangles.push_back({a, b, b + 1});
      prism.triangles.push_back({a, b + 1, a + 1});
    }
  }
  for (const auto& [a, b, c] : object::TriangulatePolygon(polygon)) {
    prism.triangles.push_back({2 * a, 2 * c, 2 * b});
    prism.triangles.push_back({2 * a + 1, 2 * b + 1, 2 * c + 1});
  }
  return prism;
}

}  // namespace

VisibleSurface MakeVisibleSurface(const object::Object& object, double thickness) {
  if (const auto* polygon = dynamic_cast<const object::Polygon*>(&object)) {
    return MakePrism(*polygon, thickness);
  }
  const auto& body = dynamic_cast<const object::Polyhedron&>(object);
  return {body.vertices(), body.triangles()};
}

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Rectangle = Kernel::Iso_rectangle_2;
using Ring = std::vector<Point>;

/// Relative difference below which areas are equal: rounding of clipped corners. Notches smaller
/// than a ten-thousandth of the patch's side may be missed.
constexpr double kAreaTolerance = 1e-9;

/// Share of the square below which pieces are slivers of rounding along its border, unless the face
/// itself is that small.
constexpr double kLeastPiece = 1e-8;

/// Share of the largest piece below which pieces are slivers on a small face.
constexpr double kLeastOfLargest = 1e-3;

/// Half the side of the smallest patch, over D: closer points are equal when files are read.
constexpr double kPointPatch = object::kPointTolerance;

/// Largest number of halvings of rectangles near the corners of a face, if another shape is valid.
/// They shrink to 3e-4 of the diameter for a path and 8e-5 for a point. Holding fingers slip by a
/// thousandth of that, and a fingertip of 0.04 D rolls that far within the rotation limit of the
/// object.
constexpr int kPathHalvings = 6, kPointHalvings = 8;

/// Width of the narrowest shape that is not a rectangle, over D. On narrower shapes the engine's
/// contacts are so inaccurate that fingers slip.
constexpr double kLeastWidth = 1e-3;

/// Coordinates in the plane of a face: u along `axis`, v to its left seen from outside.
struct Chart {
  Vector3d origin, u, v;

  [[nodiscard]] Point Project(const Vector3d& p) const {
    return {u.dot(p - origin), v.dot(p - origin)};
  }
  [[nodiscard]] Vector3d Lift(const Point& p) const { return origin + p.x() * u + p.y() * v; }
};

/// Return the direction of the path.
/// For a point, it is that of the nearest border, so that a rectangle can be aligned with it.
Vector3d ChartAxis(const object::Polyhedron& body, const ContactSite& site) {
  const Vector3d path = site.to - site.from;
  if (path.norm() > object::kPointTolerance * body.diameter()) return path;
  Vector3d axis = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const object::FaceBorder& border : body.BordersOf(site.face)) {
    const Vector3d nearest = object::ClosestOnSegment(border.a, border.b, site.from);
    const double distance = (nearest - site.from).norm();
    if (distance < least) {
      least = distance;
      axis = border.b - border.a;
    }
  }
  return axis;
}

Chart MakeChart(const object::Polyhedron& body, const ContactSite& site) {
  const Vector3d outward = -body.inward_normal(site.face);
  Vector3d u = ChartAxis(body, site);
  u = (u - u.dot(outward) * outward).normalized();
  return {site.from, u, outward.cross(u)};
}

double Area(const Ring& ring) {
  return std::abs(CGAL::polygon_area_2(ring.begin(), ring.end(), Kernel()));
}

void DropSlivers(std::vector<Ring>& pieces, double window_area) {
  double largest = 0;
  for (const Ring& piece : pieces) largest = std::max(largest, Area(piece));
  const double least = std::min(kLeastPiece * window_area, kLeastOfLargest * largest);
  std::erase_if(pieces, [&](const Ring& piece) { return Area(piece) <= least; });
}

std::vector<Ring> ClipTriangles(const object::Polyhedron& body, FaceIndex face, const Chart& chart,
                                const Rectangle& window) {
  std::vector<Ring> pieces;
  for (const object::TriangleIndex t : body.TrianglesOf(face)) {
    const auto& [a, b, c] = body.triangles()[t];
    const Kernel::Triangle_2 triangle(chart.Project(body.vertices()[a]),
                                      chart.Project(body.vertices()[b]),
                                      chart.Project(body.vertices()[c]));
    if (triangle.is_degenerate()) continue;
    const auto common = CGAL::intersection(triangle, window);
    if (!common) continue;
    Ring ring;
    if (const auto* cut = boost::get<Kernel::Triangle_2>(&*common)) {
      ring = {cut->vertex(0), cut->vertex(1), cut->vertex(2)};
    } else if (const auto* polygon = boost::get<Ring>(&*common)) {
      ring = *polygon;
    } else {
      continue;
    }
    pieces.push_back(std::move(ring));
  }
  DropSlivers(pieces, window.area());
  return pieces;
}

double TotalArea(const std::vector<Ring>& pieces) {
  double area = 0;
  for (const Ring& piece : pieces) area += Area(piece);
  return area;
}

/// Return a rectangle along u that reaches `size` from the path on all sides.
/// If it does not fit, its ends and sides are shortened to the distance of the nearest border.
/// nullopt if none fits.
std::optional<Rectangle> FittingWindow(const object::Polyhedron& body, const ContactSite& site,
                                       const Chart& chart, double size) {
  const double end = chart.u.dot(site.to - site.from);
  const double reach = std::min(size, body.DistanceToBorder(site.face, site.from));
  constexpr std::pair<bool, bool> kCuts[] = {{false, false}, {true, false}, {false, true}};
  for (const auto& [cut_start, cut_end] : kCuts) {
    for (const bool cut_right : {false, true}) {
      const Point low(cut_start ? -reach : -size, cut_right ? -reach : -size);
      const Point high(end + (cut_end ? reach : size), cut_right ? size : reach);
      const Rectangle window(low, high);
      const double covered = TotalArea(ClipTriangles(body, site.face, chart, window));
      if (covered > (1 - kAreaTolerance) * window.area()) return window;
    }
  }
  return std::nullopt;
}

/// Return the largest fitting window of `size`, half of it, a quarter of it …, down to `least`.
std::optional<Rectangle> LargestFittingWindow(const object::Polyhedron& body,
                                              const ContactSite& site, const Chart& chart,
                                              double size, double least) {
  for (; size >= least; size /= 2) {
    if (const auto window = FittingWindow(body, site, chart, size)) return window;
  }
  return std::nullopt;
}

/// Return the rectangle that reaches `size` from the path on all sides.
Rectangle WholeWindow(const ContactSite& site, const Chart& chart, double size) {
  return {Point(-size, -size), Point(chart.u.dot(site.to - site.from) + size, size)};
}

/// Return at most twice the distance of the nearest two parallel lines around a convex ring.
double Width(const Ring& ring) {
  double longest = 0;
  for (const Point& a : ring) {
    for (const Point& b : ring) longest = std::max(longest, CGAL::squared_distance(a, b));
  }
  return longest > 0 ? 2 * Area(ring) / std::sqrt(longest) : 0;
}

Ring Hull(const std::vector<Ring>& pieces) {
  Ring corners, hull;
  for (const Ring& piece : pieces) corners.insert(corners.end(), piece.begin(), piece.end());
  CGAL::convex_hull_2(corners.begin(), corners.end(), std::back_inserter(hull));
  return hull;
}

ContactPatch Lift(const Chart& chart, Ring ring, bool rectangle) {
  if (CGAL::orientation_2(ring.begin(), ring.end()) == CGAL::CLOCKWISE) {
    std::reverse(ring.begin(), ring.end());
  }
  ContactPatch patch;
  patch.rectangle = rectangle;
  for (const Point& p : ring) patch.outline.push_back(chart.Lift(p));
  return patch;
}

ContactPatch LiftRectangle(const Chart& chart, const Rectangle& window) {
  return Lift(chart, {window[0], window[1], window[2], window[3]}, true);
}

}  // namespace

std::vector<ContactPatch> MakeContactPatches(const object::Polyhedron& body,
                                             const ContactSite& site, double size) {
  const Chart chart = MakeChart(body, site);
  const bool rests = site.from == site.to;
  const double least = std::ldexp(size, rests ? -kPointHalvings : -kPathHalvings);
  if (const auto window = LargestFittingWindow(body, site, chart, size, least)) {
    return {LiftRectangle(chart, *window)};
  }
  const std::vector<Ring> pieces =
      ClipTriangles(body, site.face, chart, WholeWindow(site, chart, size));
  const Ring hull = Hull(pieces);
  const bool wide = Width(hull) >= kLeastWidth * body.diameter();
  if (wide && Area(hull) * (1 - kAreaTolerance) <= TotalArea(pieces)) {
    return {Lift(chart, hull, false)};
  }
  const double point = kPointPatch * body.diameter();
  if (!wide || rests) {
    const auto window = LargestFittingWindow(body, site, chart, least / 2, point);
    if (window) return {LiftRectangle(chart, *window)};
  }
  if (!wide) return {LiftRectangle(chart, WholeWindow(site, chart, point))};
  std::vector<ContactPatch> patches;
  for (const Ring& piece : pieces) patches.push_back(Lift(chart, piece, false));
  return patches;
}

ContactPatch MakeEdgePatch(const object::Polygon& polygon, const ContactSite& site, double size,
                           double thickness) {
  const auto [start, end] = polygon.edge(site.face);
  const double length = polygon.face_measure(site.face);
  const Vector3d along = (end - start) / length;
  const auto [low, high] = std::minmax({along.dot(site.from - start), along.dot(site.to - start)});
  const Vector3d a = start + std::max(low - size, 0.0) * along;
  const Vector3d b = start + std::min(high + size, length) * along;
  const Vector3d up = thickness / 2 * Vector3d::UnitZ();
  return {{a - up, b - up, b + up, a + up}, true};
}

}  // namespace regrasp::sim
