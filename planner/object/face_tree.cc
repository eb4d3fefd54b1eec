#include "planner/object/face_tree.h"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <ranges>
#include <set>
#include <span>
#include <unordered_map>

#include "planner/object/segment.h"

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;

/// Smallest number of triangles or border segments of a face for which a tree is faster than a
/// loop.
constexpr std::ptrdiff_t kFew = 16;

/// Bound on the rounding of distances, divided by the diameter. Within it, two triangles with a
/// common edge leave no gap on a segment that crosses the edge.
constexpr double kRounding = 1e-12;

/// Additional bound due to the rounding of coordinates, divided by the largest coordinate: a few
/// units in the last place.
constexpr double kCoordinateRounding = 1e-15;

/// Number of pieces of a segment query, because most of the box of an oblique segment is far from
/// it.
constexpr int kSegmentPieces = 16;

Point ToPoint(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }
Vector3d ToVector(const Point& p) { return {p.x(), p.y(), p.z()}; }

Triangle TriangleOf(const Polyhedron& solid, TriangleIndex t) {
  const auto& [a, b, c] = solid.triangles()[t];
  return {ToPoint(solid.vertices()[a]), ToPoint(solid.vertices()[b]), ToPoint(solid.vertices()[c])};
}

/// Return whether a point can be projected onto a triangle.
///
/// The normal of a sliver is undefined if its square underflows. Its neighbours then contain all of
/// its points up to an error far below rounding.
bool HasPlane(const Triangle& triangle) {
  const auto normal = CGAL::normal(triangle[0], triangle[1], triangle[2]);
  return normal.squared_length() >= std::numeric_limits<double>::min();
}
bool HasPlane(const Segment&) { return true; }  // a segment needs no plane, and its ends differ

/// Return the triangles of a face as a lazy range.
auto TrianglesOf(const Polyhedron& solid, FaceIndex face) {
  return solid.TrianglesOf(face) |
         std::views::transform([&](TriangleIndex t) { return TriangleOf(solid, t); });
}

/// Return the borders of a face as a lazy range of segments.
auto SegmentsOf(const Polyhedron& solid, FaceIndex face) {
  return solid.BordersOf(face) | std::views::transform([](const FaceBorder& border) {
           return Segment(ToPoint(border.a), ToPoint(border.b));
         });
}

/// Return the nearest point of some triangles or segments.
Point ClosestOf(const auto& primitives, const Point& point) {
  const auto project = Kernel().construct_projected_point_3_object();
  Point closest = (*primitives.begin())[0];
  double least = std::numeric_limits<double>::infinity();
  for (const auto& primitive : primitives) {
    const Point candidate = project(primitive, point);
    const double distance = CGAL::squared_distance(candidate, point);
    if (!(distance < least)) continue;  // also true for NaN
    least = distance;
    closest = candidate;
  }
  return closest;
}

/// Tree of the triangles or segments of one face.
template <class Shape, class Primitive>
class Patch {
 public:
  using Iterator = typename Primitive::Id;

  explicit Patch(const auto& shapes) : shapes_(shapes.begin(), shapes.end()) {
    for (Iterator i = shapes_.cbegin(); i != shapes_.cend(); ++i) {
      if (HasPlane(*i)) tree_.insert(Primitive(i));
    }
    tree_.build();  // not lazily, because queries from several threads would race
    tree_.do_not_accelerate_distance_queries();
  }

  [[nodiscard]] Point Closest(const Point& point) const {
    // The tree prunes by the distance to an initial guess: any point of the patch.
    return tree_.closest_point(point, shapes_[0][0]);
  }

  /// Call `visit` with each element whose box may intersect `box`.
  void VisitNear(const CGAL::Bbox_3& box, const auto& visit) const {
    std::vector<Iterator> found;
    tree_.all_intersected_primitives(box, std::back_inserter(found));
    for (const Iterator& i : found) visit(*i);
  }

 private:
  std::vector<Shape> shapes_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

using TrianglePatch =
    Patch<Triangle, CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>>;
using SegmentPatch =
    Patch<Segment, CGAL::AABB_segment_primitive<Kernel, std::vector<Segment>::const_iterator>>;

/// Trees of the faces that have one.
template <class AnyPatch>
using Patches = std::unordered_map<FaceIndex, std::unique_ptr<const AnyPatch>>;

template <class AnyPatch>
const AnyPatch* Find(const Patches<AnyPatch>& patches, FaceIndex face) {
  const auto found = patches.find(face);
  return found == patches.end() ? nullptr : found->second.get();
}

double DistanceTo(const Triangle& triangle, const Vector3d& point) {
  const Point closest = Kernel().construct_projected_point_3_object()(triangle, ToPoint(point));
  return (ToVector(closest) - point).norm();
}

double DistanceTo(const Triangle& triangle, const Segment& segment) {
  if (CGAL::do_intersect(triangle, segment)) return 0;
  double least = std::min(CGAL::squared_distance(segment.source(), triangle),
                          CGAL::squared_distance(segment.target(), triangle));
  for (int i = 0; i < 3; ++i) {
    const Segment side(triangle.vertex(i), triangle.vertex(i + 1));
    least = std::min(least, CGAL::squared_distance(segment, side));
  }
  return std::sqrt(least);
}

using PlanePoint = Kernel::Point_2;
using PlaneTriangle = std::array<PlanePoint, 3>;

Vector3d InSpace(const PlanePoint& p) { return {p.x(), p.y(), 0}; }

/// Projection along a normal onto a plane through a point.
class PlaneView {
 public:
  PlaneView(const Vector3d& origin, const Vector3d& normal)
      : origin_(origin), u_(normal.unitOrthogonal()), v_(normal.cross(u_)) {}

  [[nodiscard]] PlanePoint Of(const Vector3d& p) const {
    return {u_.dot(p - origin_), v_.dot(p - origin_)};
  }
  [[nodiscard]] PlaneTriangle Of(const Triangle& triangle) const {
    return {Of(ToVector(triangle[0])), Of(ToVector(triangle[1])), Of(ToVector(triangle[2]))};
  }

 private:
  Vector3d origin_, u_, v_;
};

/// Compute the distance of a point from a triangle. The triangle may be degenerate: a triangle
/// perpendicular to the plane projects to a segment.
double DistanceTo(const PlaneTriangle& triangle, const PlanePoint& point) {
  const auto& [a, b, c] = triangle;
  const auto side = CGAL::orientation(a, b, point);
  if (side != CGAL::COLLINEAR && side == CGAL::orientation(b, c, point) &&
      side == CGAL::orientation(c, a, point)) {
    return 0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    least = std::min(
        least,
        (ClosestOnSegment(InSpace(from), InSpace(to), InSpace(point)) - InSpace(point)).norm());
  }
  return least;
}

BoxTree::Box Around(const Vector3d& a, const Vector3d& b, double distance) {
  return {a.cwiseMin(b).array() - distance, a.cwiseMax(b).array() + distance};
}

CGAL::Bbox_3 ToBbox(const BoxTree::Box& box) {
  const Vector3d &low = box.min(), &high = box.max();
  return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

}  // namespace

struct FaceTree::Impl {
  double rounding = 0;             ///< bound on the error of distances between surface points
  Patches<TrianglePatch> surface;  ///< trees of faces with at least kFew triangles
  Patches<SegmentPatch> border;    ///< trees of faces with at least kFew borders
  BoxTree triangles;

  [[nodiscard]] Vector3d ClosestPoint(const Polyhedron& solid, FaceIndex face,
                                      const Vector3d& point) const {
    const TrianglePatch* patch = Find(surface, face);
    return ToVector(patch != nullptr ? patch->Closest(ToPoint(point))
                                     : ClosestOf(TrianglesOf(solid, face), ToPoint(point)));
  }

  /// Call `visit` with each triangle of a face whose box intersects `box`.
  void VisitNear(const Polyhedron& solid, FaceIndex face, const CGAL::Bbox_3& box,
                 const auto& visit) const {
    if (const TrianglePatch* patch = Find(surface, face)) return patch->VisitNear(box, visit);
    for (const Triangle& triangle : TrianglesOf(solid, face)) {
      if (CGAL::do_overlap(triangle.bbox(), box)) visit(triangle);
    }
  }

  /// Call `visit` with the index of each triangle that intersects a box, and the triangle.
  void VisitNear(const Polyhedron& solid, const BoxTree::Box& box, const auto& visit) const {
    const CGAL::Bbox_3 bounds = ToBbox(box);
    triangles.VisitNear(box, [&](int i) {
      const TriangleIndex t(i);
      const Triangle triangle = TriangleOf(solid, t);
      if (CGAL::do_overlap(triangle.bbox(), bounds) && CGAL::do_intersect(bounds, triangle)) {
        visit(t, triangle);
      }
    });
  }

  [[nodiscard]] bool Covers(const Polyhedron& solid, FaceIndex face, const Vector3d& a,
                            const Vector3d& b, double within) const;
};

/// Return whether the segment ab is within a distance of the face, and its projection along the
/// face's normal is on the face up to rounding.
bool FaceTree::Impl::Covers(const Polyhedron& solid, FaceIndex face, const Vector3d& a,
                            const Vector3d& b, double within) const {
  const PlaneView view(a, solid.inward_normal(face));
  const double strictness = within / rounding;
  // The distance to a convex set is convex along a line, so the points near one triangle form an
  // interval. The segment is on the face iff the intervals of all triangles cover it.
  std::vector<ParameterInterval> near;
  VisitNear(solid, face, ToBbox(Around(a, b, within)), [&](const Triangle& triangle) {
    const PlaneTriangle seen = view.Of(triangle);
    const auto distance = [&](double t) {
      const Vector3d p = a + t * (b - a);
      const double beside = strictness * DistanceTo(seen, view.Of(p));
      return beside > within ? beside : std::max(beside, DistanceTo(triangle, p));
    };
    if (const auto interval = SublevelInterval(distance, within)) near.push_back(*interval);
  });
  return CoverUnitInterval(std::move(near));
}

FaceTree::FaceTree(const Polyhedron& solid) {
  auto impl = std::make_unique<Impl>();
  double farthest = 0;
  for (const Vector3d& vertex : solid.vertices()) farthest = std::max(farthest, vertex.norm());
  impl->rounding = kRounding * solid.diameter() + kCoordinateRounding * farthest;
  for (FaceIndex f{0}; f < solid.face_count(); ++f) {
    if (std::ssize(solid.TrianglesOf(f)) >= kFew) {
      impl->surface.emplace(f, std::make_unique<TrianglePatch>(TrianglesOf(solid, f)));
    }
    if (std::ssize(solid.BordersOf(f)) >= kFew) {
      impl->border.emplace(f, std::make_unique<SegmentPatch>(SegmentsOf(solid, f)));
    }
  }
  impl->triangles = BoxTree(static_cast<int>(solid.triangles().size()), [&](int t) {
    BoxTree::Box box;
    for (const int v : solid.triangles()[t]) box.extend(solid.vertices()[v]);
    return box;
  });
  impl_ = std::move(impl);
}

FaceTree::~FaceTree() = default;

Vector3d FaceTree::ClosestPoint(const Polyhedron& solid, FaceIndex face,
                                const Vector3d& point) const {
  return impl_->ClosestPoint(solid, face, point);
}

std::vector<FaceIndex> FaceTree::FacesNear(const Polyhedron& solid, const Vector3d& point,
                                           double tolerance) const {
  // Enlarged by more than rounding; the distances below decide.
  const BoxTree::Box box = Around(point, point, tolerance + kRounding * solid.diameter());
  std::map<FaceIndex, double> distance_to;
  impl_->VisitNear(solid, box, [&](TriangleIndex t, const Triangle& triangle) {
    const double distance = DistanceTo(triangle, point);
    if (!(distance <= tolerance)) return;
    const auto [found, is_new] = distance_to.try_emplace(solid.face_of_triangle(t), distance);
    found->second = std::min(found->second, distance);
  });
  std::vector<FaceIndex> faces;
  for (const auto& [face, distance] : distance_to) faces.push_back(face);
  std::ranges::stable_sort(faces, {}, [&](FaceIndex face) { return distance_to.at(face); });
  return faces;
}

std::vector<FaceIndex> FaceTree::FacesNearSegment(const Polyhedron& solid, const Vector3d& a,
                                                  const Vector3d& b, double tolerance) const {
  const Segment segment(ToPoint(a), ToPoint(b));
  const double within = tolerance + kRounding * solid.diameter();
  std::set<FaceIndex> faces;
  for (int piece = 0; piece < kSegmentPieces; ++piece) {
    const auto at = [&](int k) -> Vector3d { return a + k * (b - a) / kSegmentPieces; };
    const BoxTree::Box box = Around(at(piece), at(piece + 1), within);
    impl_->VisitNear(solid, box, [&](TriangleIndex t, const Triangle& triangle) {
      const FaceIndex face = solid.face_of_triangle(t);
      if (faces.contains(face)) return;
      if (DistanceTo(triangle, segment) <= tolerance) faces.insert(face);
    });
  }
  return {faces.begin(), faces.end()};
}

double FaceTree::DistanceToBorder(const Polyhedron& solid, FaceIndex face,
                                  const Vector3d& point) const {
  const SegmentPatch* patch = Find(impl_->border, face);
  const Point closest = patch != nullptr ? patch->Closest(ToPoint(point))
                                         : ClosestOf(SegmentsOf(solid, face), ToPoint(point));
  return (ToVector(closest) - point).norm();
}

bool FaceTree::ContainsSegment(const Polyhedron& solid, FaceIndex face, const Vector3d& a,
                               const Vector3d& b, double tolerance) const {
  const double within = std::max(tolerance, kRounding * solid.diameter());
  const auto closest = [&](const Vector3d& p) { return impl_->ClosestPoint(solid, face, p); };
  const auto covers = [&](const Vector3d& p, const Vector3d& q) {
    return impl_->Covers(solid, face, p, q, within);
  };
  const Vector3d from = closest(a), to = closest(b);
  if ((from - a).norm() > within || (to - b).norm() > within) return false;
  if (covers(from, to)) return true;
  // The ends are known only up to the tolerance. A parallel path suffices if both ends can move to
  // it without leaving the face.
  const Vector3d aside = within * solid.inward_normal(face).cross(to - from).stableNormalized();
  const auto ends = [&](const Vector3d& end) {
    std::vector<Vector3d> found = {end};
    for (const Vector3d& off : {aside, Vector3d(-aside)}) {
      const Vector3d moved = closest(end + off);
      if (covers(end, moved)) found.push_back(moved);
    }
    return found;
  };
  const std::vector<Vector3d> starts = ends(from), stops = ends(to);
  return std::ranges::any_of(starts, [&](const Vector3d& start) {
    return std::ranges::any_of(stops, [&](const Vector3d& stop) { return covers(start, stop); });
  });
}

namespace {

/// Maximum number of items per leaf. Fewer need more memory; more cause unnecessary visits.
constexpr std::ptrdiff_t kLeaf = 6;

}  // namespace

class BoxTree::Builder {
 public:
  Builder(BoxTree& tree, const std::function<Box(int)>& box_of) : tree_(tree), box_of_(box_of) {
    centres_.reserve(tree.order_.size());
    for (const int i : tree.order_) centres_.push_back(box_of(i).center());
    tree.nodes_.reserve(NodesOver(tree.order_.size()));
  }

  /// Build the subtree of some items. @returns index of its root.
  int Build(std::span<std::int32_t> things) {
    const int at = static_cast<int>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    if (std::ssize(things) <= kLeaf) {
      Node& leaf = tree_.nodes_[at];
      for (const int i : things) leaf.box.extend(box_of_(i));
      leaf.first = static_cast<std::int32_t>(things.data() - tree_.order_.data());
      leaf.count = static_cast<std::int32_t>(things.size());
      return at;
    }
    const std::size_t half = things.size() / 2;
    SortHalves(things, half);
    const int first = Build(things.first(half)), second = Build(things.subspan(half));
    Node& node = tree_.nodes_[at];
    node.box = tree_.nodes_[first].box.merged(tree_.nodes_[second].box);
    node.second = second;
    return at;
  }

 private:
  /// Return the number of nodes of a tree with this many items.
  static std::size_t NodesOver(std::size_t things) {
    if (things <= std::size_t{kLeaf}) return 1;
    return 1 + NodesOver(things / 2) + NodesOver(things - things / 2);
  }

  /// Split items at the median along the direction in which their centres differ most.
  void SortHalves(std::span<std::int32_t> things, std::size_t half) const {
    Box centres;
    for (const int i : things) centres.extend(centres_[i]);
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    std::ranges::nth_element(things, things.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [&](int i) { return std::pair(centres_[i][axis], i); });
  }

  BoxTree& tree_;
  const std::function<Box(int)>& box_of_;
  std::vector<Eigen::Vector3d> centres_;
};

BoxTree::BoxTree(int count, const std::function<Box(int)>& box_of) : order_(count) {
  if (count == 0) return;
  std::iota(order_.begin(), order_.end(), 0);
  Builder(*this, box_of).Build(order_);
}

}  // namespace regrasp::object
