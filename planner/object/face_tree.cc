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
#include <set>

#include "planner/object/closest_on_segment.h"
#include "planner/object/segment_coverage.h"

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;

/// Faces with fewer triangles or border segments are searched one by one, which is then faster.
constexpr std::ptrdiff_t kFew = 16;

/// Distances are rounded: within this times the diameter two triangles that share an edge leave no
/// gap, however a segment crosses it.
constexpr double kRounding = 1e-12;

/// What the rounding of coordinates adds to that, over the largest of them: some units in the last
/// place.
constexpr double kCoordinateRounding = 1e-15;

/// A segment is sought in so many pieces: the box around an oblique one is mostly far from it.
constexpr int kSegmentPieces = 16;

Point ToPoint(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }
Vector3d ToVector(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// Whether a point can be projected on it. The normal of a sliver is lost where its square
/// underflows; all of such a triangle is then at its neighbours, to far below rounding.
bool HasPlane(const Triangle& triangle) {
  const auto normal = CGAL::normal(triangle[0], triangle[1], triangle[2]);
  return normal.squared_length() >= std::numeric_limits<double>::min();
}
bool HasPlane(const Segment&) { return true; }  // a line is enough, and corners are apart

/// Consecutive primitives (triangles or segments) of one face, with a tree where they are many.
template <class Primitive>
class Patch {
 public:
  using Iterator = typename Primitive::Id;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

  Patch(Iterator first, Iterator last) : first_(first), last_(last) {
    if (last - first < kFew) return;
    tree_ = std::make_unique<Tree>();
    for (Iterator i = first; i != last; ++i) {
      if (HasPlane(*i)) tree_->insert(Primitive(i));
    }
    tree_->build();  // now, as queries from several threads would build it twice
    tree_->do_not_accelerate_distance_queries();
  }

  [[nodiscard]] Point Closest(const Point& point) const {
    // The tree starts from a guess and prunes by it: any point of the patch will do.
    if (tree_) return tree_->closest_point(point, (*first_)[0]);
    const auto project = Kernel().construct_projected_point_3_object();
    Point closest = (*first_)[0];
    double least = std::numeric_limits<double>::infinity();
    for (Iterator i = first_; i != last_; ++i) {
      const Point candidate = project(*i, point);
      const double distance = CGAL::squared_distance(candidate, point);
      if (!(distance < least)) continue;  // nor where it is no number, for want of a plane
      least = distance;
      closest = candidate;
    }
    return closest;
  }

  /// Calls `visit` with every primitive whose box may meet `box`.
  template <class Visit>
  void VisitNear(const CGAL::Bbox_3& box, const Visit& visit) const {
    if (!tree_) {
      for (Iterator i = first_; i != last_; ++i) {
        if (CGAL::do_overlap(i->bbox(), box)) visit(*i);
      }
      return;
    }
    std::vector<Iterator> found;
    tree_->all_intersected_primitives(box, std::back_inserter(found));
    for (const Iterator& i : found) visit(*i);
  }

 private:
  Iterator first_, last_;
  std::unique_ptr<Tree> tree_;
};

using TriangleIterator = std::vector<Triangle>::const_iterator;
using SegmentIterator = std::vector<Segment>::const_iterator;
using TrianglePrimitive = CGAL::AABB_triangle_primitive<Kernel, TriangleIterator>;
using SegmentPrimitive = CGAL::AABB_segment_primitive<Kernel, SegmentIterator>;
using TriangleTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, TrianglePrimitive>>;

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

/// What one sees along a normal, from a point.
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

/// Of triangles that may be flat too: those that stand upright in a face.
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

CGAL::Bbox_3 Around(const Vector3d& a, const Vector3d& b, double distance) {
  const Vector3d low = a.cwiseMin(b).array() - distance;
  const Vector3d high = a.cwiseMax(b).array() + distance;
  return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

}  // namespace

struct FaceTree::Impl {
  double diameter = 0;
  double rounding = 0;              ///< of distances between points of the surface
  std::vector<Vector3d> normals;    ///< by face
  std::vector<Triangle> triangles;  ///< sorted by face
  std::vector<FaceIndex> face_of_triangle;
  std::vector<Segment> segments;  ///< borders, sorted by face
  std::vector<Patch<TrianglePrimitive>> surface;
  std::vector<Patch<SegmentPrimitive>> border;
  TriangleTree tree;

  [[nodiscard]] bool Covers(FaceIndex face, const Vector3d& a, const Vector3d& b,
                            double within) const;
};

/// True iff the segment ab is within a distance of the face, and over it up to rounding where one
/// looks along its normal.
bool FaceTree::Impl::Covers(FaceIndex face, const Vector3d& a, const Vector3d& b,
                            double within) const {
  const PlaneView view(a, normals[face]);
  const double strictness = within / rounding;
  // The points near one triangle form an interval, as the distance to a convex set is convex along
  // a line: the segment is on the face iff the intervals of all triangles cover it.
  std::vector<ParameterInterval> near;
  surface[face].VisitNear(Around(a, b, within), [&](const Triangle& triangle) {
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
  impl->diameter = solid.diameter();
  double farthest = 0;
  for (const Vector3d& vertex : solid.vertices()) farthest = std::max(farthest, vertex.norm());
  impl->rounding = kRounding * impl->diameter + kCoordinateRounding * farthest;
  std::vector<std::ptrdiff_t> triangle_ends, segment_ends;
  const auto faces = static_cast<std::size_t>(solid.face_count());
  std::size_t borders = 0;
  for (FaceIndex f{0}; f < solid.face_count(); ++f) borders += solid.BordersOf(f).size();
  impl->triangles.reserve(solid.triangles().size());
  impl->face_of_triangle.reserve(solid.triangles().size());
  impl->segments.reserve(borders);
  impl->normals.reserve(faces);
  impl->surface.reserve(faces);
  impl->border.reserve(faces);
  for (FaceIndex f{0}; f < solid.face_count(); ++f) {
    impl->normals.push_back(solid.inward_normal(f));
    for (const TriangleIndex t : solid.TrianglesOf(f)) {
      const auto& [a, b, c] = solid.triangles()[t];
      impl->triangles.emplace_back(ToPoint(solid.vertices()[a]), ToPoint(solid.vertices()[b]),
                                   ToPoint(solid.vertices()[c]));
      impl->face_of_triangle.push_back(f);
    }
    for (const FaceBorder& border : solid.BordersOf(f)) {
      impl->segments.emplace_back(ToPoint(border.a), ToPoint(border.b));
    }
    triangle_ends.push_back(std::ssize(impl->triangles));
    segment_ends.push_back(std::ssize(impl->segments));
  }
  // Only now: the patches keep iterators.
  const auto first_triangle = impl->triangles.cbegin();
  const auto first_segment = impl->segments.cbegin();
  for (FaceIndex f{0}; f < solid.face_count(); ++f) {
    impl->surface.emplace_back(first_triangle + (f == 0 ? 0 : triangle_ends[f - 1]),
                               first_triangle + triangle_ends[f]);
    impl->border.emplace_back(first_segment + (f == 0 ? 0 : segment_ends[f - 1]),
                              first_segment + segment_ends[f]);
  }
  impl->tree.insert(first_triangle, impl->triangles.cend());
  impl->tree.build();
  impl_ = std::move(impl);
}

FaceTree::~FaceTree() = default;

Vector3d FaceTree::ClosestPoint(FaceIndex face, const Vector3d& point) const {
  return ToVector(impl_->surface[face].Closest(ToPoint(point)));
}

std::vector<FaceIndex> FaceTree::FacesNear(const Vector3d& point, double tolerance) const {
  // Wider than asked by more than rounding; the distances below decide.
  const CGAL::Bbox_3 box = Around(point, point, tolerance + kRounding * impl_->diameter);
  std::vector<TriangleIterator> candidates;
  impl_->tree.all_intersected_primitives(box, std::back_inserter(candidates));
  std::map<FaceIndex, double> distance_to;
  for (const TriangleIterator& candidate : candidates) {
    const double distance = DistanceTo(*candidate, point);
    if (!(distance <= tolerance)) continue;
    const FaceIndex face = impl_->face_of_triangle[candidate - impl_->triangles.cbegin()];
    const auto [found, is_new] = distance_to.try_emplace(face, distance);
    found->second = std::min(found->second, distance);
  }
  std::vector<FaceIndex> faces;
  for (const auto& [face, distance] : distance_to) faces.push_back(face);
  std::ranges::stable_sort(faces, {}, [&](FaceIndex face) { return distance_to.at(face); });
  return faces;
}

std::vector<FaceIndex> FaceTree::FacesNearSegment(const Vector3d& a, const Vector3d& b,
                                                  double tolerance) const {
  const Segment segment(ToPoint(a), ToPoint(b));
  const double within = tolerance + kRounding * impl_->diameter;
  std::set<FaceIndex> faces;
  std::vector<TriangleIterator> candidates;
  for (int piece = 0; piece < kSegmentPieces; ++piece) {
    const auto at = [&](int k) -> Vector3d { return a + k * (b - a) / kSegmentPieces; };
    candidates.clear();
    impl_->tree.all_intersected_primitives(Around(at(piece), at(piece + 1), within),
                                           std::back_inserter(candidates));
    for (const TriangleIterator& candidate : candidates) {
      const FaceIndex face = impl_->face_of_triangle[candidate - impl_->triangles.cbegin()];
      if (faces.contains(face)) continue;
      if (DistanceTo(*candidate, segment) <= tolerance) faces.insert(face);
    }
  }
  return {faces.begin(), faces.end()};
}

double FaceTree::DistanceToBorder(FaceIndex face, const Vector3d& point) const {
  return (ToVector(impl_->border[face].Closest(ToPoint(point))) - point).norm();
}

bool FaceTree::ContainsSegment(FaceIndex face, const Vector3d& a, const Vector3d& b,
                               double tolerance) const {
  const double within = std::max(tolerance, kRounding * impl_->diameter);
  const Vector3d from = ClosestPoint(face, a), to = ClosestPoint(face, b);
  if ((from - a).norm() > within || (to - b).norm() > within) return false;
  if (impl_->Covers(face, from, to, within)) return true;
  // The ends are known to within the tolerance: a path beside this one, to which both ends can go
  // without leaving the face, will do.
  const Vector3d aside = within * impl_->normals[face].cross(to - from).stableNormalized();
  const auto ends = [&](const Vector3d& end) {
    std::vector<Vector3d> found = {end};
    for (const Vector3d& off : {aside, Vector3d(-aside)}) {
      const Vector3d moved = ClosestPoint(face, end + off);
      if (impl_->Covers(face, end, moved, within)) found.push_back(moved);
    }
    return found;
  };
  const std::vector<Vector3d> starts = ends(from), stops = ends(to);
  return std::ranges::any_of(starts, [&](const Vector3d& start) {
    return std::ranges::any_of(
        stops, [&](const Vector3d& stop) { return impl_->Covers(face, start, stop, within); });
  });
}

}  // namespace regrasp::object
