#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/resolve_touching.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;
using Eigen::Vector3d;

namespace {

/// Intersections must be exact: at a common point of three triangles, each is cut by the other two.
using ArrangementKernel = ExactKernel;
using Cutting = CGAL::Constrained_Delaunay_triangulation_2<ArrangementKernel, CGAL::Default,
                                                           CGAL::Exact_intersections_tag>;
using Corners = std::array<int, 3>;

/// Largest number of intersecting pairs; more take minutes.
constexpr std::size_t kMostPairs = 200'000;

/// Distance of a winding number from an integer beyond which the surface is not closed.
constexpr double kWholeNumber = 0.25;

/// Disjoint sets of integers (union-find).
class Sets {
 public:
  explicit Sets(std::size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), 0); }
  int Find(int member) {
    while (root_[member] != member) member = root_[member] = root_[root_[member]];
    return member;
  }
  void Unite(int one, int other) { root_[Find(other)] = Find(one); }

  /// Return the members of each set, in the order of the roots.
  std::vector<std::vector<int>> All() {
    std::map<int, std::vector<int>> by_root;
    for (int i = 0; i < std::ssize(root_); ++i) by_root[Find(i)].push_back(i);
    std::vector<std::vector<int>> all;
    for (auto& [unused, members] : by_root) all.push_back(std::move(members));
    return all;
  }

 private:
  std::vector<int> root_;
};

/// Closed surface of triangles with distinct vertices.
struct SoupSurface {
  std::vector<Vector3d> vertices;
  std::vector<Corners> triangles;

  [[nodiscard]] std::array<Vector3d, 3> At(int triangle) const {
    const Corners& t = triangles[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
  void Turn(int triangle) { std::swap(triangles[triangle][1], triangles[triangle][2]); }
};

Kernel::Point_3 ToKernelPoint(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
ExactPoint ToExact(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

bool HasArea(const std::array<Vector3d, 3>& t) {
  return !CGAL::collinear(ToKernelPoint(t[0]), ToKernelPoint(t[1]), ToKernelPoint(t[2]));
}

SoupSurface SurfaceOf(const object::PolygonSoup& soup) {
  std::map<std::array<double, 3>, int> number;
  SoupSurface surface;
  std::vector<int> twin;
  for (const Vector3d& v : soup.vertices) {
    const auto [at, is_new] =
        number.try_emplace({v.x(), v.y(), v.z()}, static_cast<int>(number.size()));
    if (is_new) surface.vertices.push_back(v);
    twin.push_back(at->second);
  }
  for (const auto& f : soup.facets)
    surface.triangles.push_back({twin[f[0]], twin[f[1]], twin[f[2]]});
  std::map<std::pair<int, int>, int> passes;  // triangles along each edge minus those against it
  for (const Corners& t : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3];
      if (from != to) passes[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  if (std::ranges::any_of(passes, [](const auto& edge) { return edge.second != 0; })) {
    throw std::runtime_error("not closed");
  }
  std::erase_if(surface.triangles, [&](const Corners& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
           !HasArea({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
  });
  return surface;
}

/// Return the solid angle of a triangle over 4π, positive as seen from its inner side (van Oosterom
/// and Strackee 1983).
double Turns(const std::array<Vector3d, 3>& t, const Vector3d& from) {
  const Vector3d a = t[0] - from, b = t[1] - from, c = t[2] - from;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double triple = a.dot(b.cross(c));
  const double sum = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return std::atan2(triple, sum) / (2 * std::numbers::pi);
}

/// Return the winding number of some triangles of a surface about a point.
double WindingNumber(const SoupSurface& surface, const std::vector<int>& triangles,
                     const Vector3d& point) {
  double sum = 0;
  for (const int t : triangles) sum += Turns(surface.At(t), point);
  return sum;
}

double SignedVolume(const SoupSurface& surface, const std::vector<int>& triangles) {
  double sum = 0;
  for (const int t : triangles) {
    const auto& [a, b, c] = surface.At(t);
    const Vector3d& origin = surface.vertices[0];
    sum += (a - origin).dot((b - origin).cross(c - origin)) / 6;
  }
  return sum;
}

/// Orient shells outwards. Cavities, that is inward shells inside another shell, are kept.
void TurnSurfaceOutwards(SoupSurface& surface) {
  Sets connected(surface.vertices.size());
  for (const Corners& t : surface.triangles) {
    connected.Unite(t[0], t[1]);
    connected.Unite(t[0], t[2]);
  }
  std::map<int, std::vector<int>> shells;
  for (int t = 0; t < std::ssize(surface.triangles); ++t) {
    shells[connected.Find(surface.triangles[t][0])].push_back(t);
  }
  for (const auto& [root, shell] : shells) {
    if (SignedVolume(surface, shell) >= 0) continue;
    const bool cavity = std::ranges::any_of(shells, [&](const auto& other) {
      return other.first != root && SignedVolume(surface, other.second) > 0 &&
             std::ranges::all_of(shell, [&](int t) {
               return WindingNumber(surface, other.second, surface.At(t)[0]) > 0.5;
             });
    });
    if (cavity) continue;
    for (const int t : shell) surface.Turn(t);
  }
}

/// Intersection of two triangles that are not coplanar.
struct Meeting {
  ExactPoint a, b;  ///< equal if the intersection is a point
};

/// Intersections of the triangles of a surface, contacts of neighbours excluded.
struct Meetings {
  std::vector<std::vector<Meeting>> of_triangle;
  Sets coplanar;  ///< sets of coplanar triangles with common points
  std::size_t pairs = 0;

  explicit Meetings(std::size_t triangles) : of_triangle(triangles), coplanar(triangles) {}
};

class MeetingFinder {
 public:
  explicit MeetingFinder(const SoupSurface& surface)
      : surface_(surface), meetings_(surface.triangles.size()) {}

  Meetings Find() {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
    std::vector<Box> boxes;
    for (int t = 0; t < std::ssize(surface_.triangles); ++t) {
      const auto corners = surface_.At(t);
      CGAL::Bbox_3 box;
      for (const Vector3d& v : corners) box += ToKernelPoint(v).bbox();
      boxes.emplace_back(box, t);
    }
    CGAL::box_self_intersection_d(
        boxes.begin(), boxes.end(), [&](const Box& one, const Box& other) {
          Examine(std::min(one.info(), other.info()), std::max(one.info(), other.info()));
        });
    return std::move(meetings_);
  }

 private:
  [[nodiscard]] Kernel::Point_3 Corner(int triangle, int k) const {
    return ToKernelPoint(surface_.vertices[surface_.triangles[triangle][k]]);
  }
  [[nodiscard]] bool Has(int triangle, int vertex) const {
    return std::ranges::count(surface_.triangles[triangle], vertex) > 0;
  }

  /// Return the sides of a triangle's plane on which the corners of another triangle are.
  /// Each is −1, 0 or 1. Common corners are omitted.
  [[nodiscard]] std::vector<int> SidesOf(int triangle, int other) const {
    std::vector<int> sides;
    for (int k = 0; k < 3; ++k) {
      if (Has(triangle, surface_.triangles[other][k])) continue;
      sides.push_back(CGAL::orientation(Corner(triangle, 0), Corner(triangle, 1),
                                        Corner(triangle, 2), Corner(other, k)));
    }
    return sides;
  }

  static bool OnOneSide(const std::vector<int>& sides) {
    return std::ranges::all_of(sides, [&](int s) { return s != 0 && s == sides[0]; });
  }

  void Examine(int one, int other) {
    const std::vector<int> sides = SidesOf(one, other);
    if (sides.empty()) return meetings_.coplanar.Unite(one, other);  // identical corners
    if (OnOneSide(sides) || OnOneSide(SidesOf(other, one))) return;
    const Kernel::Triangle_3 first(Corner(one, 0), Corner(one, 1), Corner(one, 2));
    const Kernel::Triangle_3 second(Corner(other, 0), Corner(other, 1), Corner(other, 2));
    if (sides.size() == 3 && !CGAL::do_intersect(first, second)) return;
    if (++meetings_.pairs > kMostPairs) throw std::runtime_error("too many triangles intersect");
    const bool flat = std::ranges::all_of(sides, [](int s) { return s == 0; });
    if (flat) return meetings_.coplanar.Unite(one, other);
    const auto common = CGAL::intersection(ExactTriangle(one), ExactTriangle(other));
    if (!common) return;
    if (const auto* p = boost::get<ExactPoint>(&*common)) Add(one, other, {*p, *p});
    if (const auto* s = boost::get<ArrangementKernel::Segment_3>(&*common)) {
      Add(one, other, {s->source(), s->target()});
    }
  }

  [[nodiscard]] ArrangementKernel::Triangle_3 ExactTriangle(int t) const {
    const auto corners = surface_.At(t);
    return {ToExact(corners[0]), ToExact(corners[1]), ToExact(corners[2])};
  }

  void Add(int one, int other, const Meeting& meeting) {
    meetings_.of_triangle[one].push_back(meeting);
    meetings_.of_triangle[other].push_back(meeting);
  }

  const SoupSurface& surface_;
  Meetings meetings_;
};

/// Projection of a plane along the coordinate axis most perpendicular to it.
/// Triangles that are counter-clockwise about the axis stay counter-clockwise.
class FlatView {
 public:
  explicit FlatView(const std::array<Vector3d, 3>& t)
      : plane_(ToExact(t[0]), ToExact(t[1]), ToExact(t[2])) {
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    normal.cwiseAbs().maxCoeff(&axis_);
    // A coefficient that rounding makes zero cannot be the projection axis.
    while (Coefficient(axis_) == 0) axis_ = (axis_ + 1) % 3;
  }

  [[nodiscard]] ArrangementKernel::Point_2 Project(const ExactPoint& p) const {
    return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]};
  }
  [[nodiscard]] ExactPoint Lift(const ArrangementKernel::Point_2& p) const {
    std::array<ArrangementKernel::FT, 3> at;
    at[(axis_ + 1) % 3] = p.x();
    at[(axis_ + 2) % 3] = p.y();
    at[axis_] = -(Coefficient((axis_ + 1) % 3) * p.x() + Coefficient((axis_ + 2) % 3) * p.y() +
                  plane_.d()) /
                Coefficient(axis_);
    return {at[0], at[1], at[2]};
  }

 private:
  [[nodiscard]] ArrangementKernel::FT Coefficient(int axis) const {
    return axis == 0 ? plane_.a() : axis == 1 ? plane_.b() : plane_.c();
  }

  ArrangementKernel::Plane_3 plane_;
  int axis_ = 0;
};

/// Triangle projected by a FlatView.
struct FlatTriangle {
  std::array<ArrangementKernel::Point_2, 3> at;
  int side;  ///< 1 if counter-clockwise, −1 if clockwise
  CGAL::Bbox_2 box;

  FlatTriangle(const FlatView& view, const std::array<Vector3d, 3>& corners) {
    for (int k = 0; k < 3; ++k) {
      at[k] = view.Project(ToExact(corners[k]));
      box += at[k].bbox();
    }
    side = CGAL::orientation(at[0], at[1], at[2]);
  }

  /// Return `side` if the triangle contains a point, otherwise 0.
  [[nodiscard]] int SideOver(const ArrangementKernel::Point_2& p) const {
    if (!CGAL::do_overlap(box, p.bbox())) return 0;
    for (int k = 0; k < 3; ++k) {
      if (CGAL::orientation(at[k], at[(k + 1) % 3], p) != side) return 0;
    }
    return side;
  }
};

/// Triangle of the arrangement that nothing intersects.
struct Piece {
  Corners corners;
  int layers = 1;  ///< number of surface layers at this place, counted with orientation; positive
  std::vector<int> under;  ///< triangles of the surface that contain the piece
};

/// Surface cut along all its self-intersections.
class Arrangement {
 public:
  explicit Arrangement(const SoupSurface& surface)
      : surface_(surface), meetings_(MeetingFinder(surface).Find()) {
    for (const Vector3d& v : surface.vertices) AddPoint(ToExact(v));
    for (const std::vector<int>& flat : meetings_.coplanar.All()) {
      if (flat.size() == 1 && meetings_.of_triangle[flat[0]].empty()) {
        pieces_.push_back({surface.triangles[flat[0]], 1, flat});
      } else {
        Cut(flat);
      }
    }
  }

  [[nodiscard]] std::size_t pairs() const { return meetings_.pairs; }

  /// Return the pieces between winding number 0 and winding number at least 1.
  [[nodiscard]] object::PolygonSoup Boundary() const {
    object::PolygonSoup soup;
    for (const ExactPoint& p : points_) {
      soup.vertices.push_back(Rounded(p));
    }
    for (const std::vector<int>& patch : Patches()) {
      const Piece& largest = pieces_[LargestOf(patch, soup.vertices)];
      const int inside = WindingInside(largest, soup.vertices);
      if (inside < 1 || inside - largest.layers >= 1) continue;
      for (const int p : patch) {
        const Corners& corners = pieces_[p].corners;
        soup.facets.push_back({corners[0], corners[1], corners[2]});
      }
    }
    return soup;
  }

 private:
  int AddPoint(const ExactPoint& p) {
    const auto [at, is_new] = number_.try_emplace(p, static_cast<int>(points_.size()));
    if (is_new) points_.push_back(p);
    return at->second;
  }

  /// Cut coplanar triangles along each other's sides and along their intersections with other
  /// triangles.
  void Cut(const std::vector<int>& flat) {
    const FlatView view(surface_.At(flat[0]));
    Cutting cutting;
    for (const int t : flat) {
      const auto corners = surface_.At(t);
      for (int k = 0; k < 3; ++k) {
        cutting.insert_constraint(view.Project(ToExact(corners[k])),
                                  view.Project(ToExact(corners[(k + 1) % 3])));
      }
      for (const Meeting& meeting : meetings_.of_triangle[t]) {
        const ArrangementKernel::Point_2 a = view.Project(meeting.a), b = view.Project(meeting.b);
        if (a == b) {
          cutting.insert(a);
        } else {
          cutting.insert_constraint(a, b);
        }
      }
    }
    std::vector<FlatTriangle> triangles;
    for (const int t : flat) triangles.emplace_back(view, surface_.At(t));
    for (const auto& face : cutting.finite_face_handles()) AddPiece(flat, triangles, view, face);
  }

  /// Add a face of the triangulation as a piece.
  /// @param triangles  projections of the triangles in `flat`, in the same order.
  void AddPiece(const std::vector<int>& flat, const std::vector<FlatTriangle>& triangles,
                const FlatView& view, Cutting::Face_handle face) {
    std::array<ArrangementKernel::Point_2, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = face->vertex(k)->point();
    Piece piece{{}, 0, {}};
    const ArrangementKernel::Point_2 middle = CGAL::centroid(corners[0], corners[1], corners[2]);
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const int side = triangles[i].SideOver(middle);
      piece.layers += side;
      if (side != 0) piece.under.push_back(flat[i]);
    }
    if (piece.layers == 0) return;
    for (int k = 0; k < 3; ++k) piece.corners[k] = AddPoint(view.Lift(corners[k]));
    if (piece.layers < 0) {
      piece.layers = -piece.layers;
      std::swap(piece.corners[1], piece.corners[2]);
    }
    pieces_.push_back(std::move(piece));
  }

  /// Return patches of pieces with the same inside and outside.
  /// Neighbours belong to one patch if they have equally many layers and their common edge has two
  /// pieces.
  [[nodiscard]] std::vector<std::vector<int>> Patches() const {
    std::map<std::pair<int, int>, std::vector<std::pair<int, bool>>> at_edge;
    for (int p = 0; p < std::ssize(pieces_); ++p) {
      for (int k = 0; k < 3; ++k) {
        const int from = pieces_[p].corners[k], to = pieces_[p].corners[(k + 1) % 3];
        at_edge[std::minmax(from, to)].emplace_back(p, from < to);
      }
    }
    Sets patches(pieces_.size());
    for (const auto& [edge, at] : at_edge) {
      if (at.size() != 2 || at[0].second == at[1].second) continue;
      if (pieces_[at[0].first].layers != pieces_[at[1].first].layers) continue;
      patches.Unite(at[0].first, at[1].first);
    }
    return patches.All();
  }

  [[nodiscard]] int LargestOf(const std::vector<int>& patch,
                              const std::vector<Vector3d>& vertices) const {
    return *std::ranges::max_element(patch, {}, [&](int p) {
      const Corners& c = pieces_[p].corners;
      return (vertices[c[1]] - vertices[c[0]]).cross(vertices[c[2]] - vertices[c[0]]).norm();
    });
  }

  /// Return the winding number of the surface on the inner side of a piece.
  [[nodiscard]] int WindingInside(const Piece& piece, const std::vector<Vector3d>& vertices) const {
    const Corners& c = piece.corners;
    const Vector3d middle = (vertices[c[0]] + vertices[c[1]] + vertices[c[2]]) / 3;
    double turns = piece.layers / 2.0;  // each layer at the piece contributes half a turn
    for (int t = 0; t < std::ssize(surface_.triangles); ++t) {
      if (std::ranges::count(piece.under, t) == 0) turns += Turns(surface_.At(t), middle);
    }
    if (std::abs(turns - std::round(turns)) > kWholeNumber) {
      throw std::runtime_error("cannot determine the interior");
    }
    return static_cast<int>(std::lround(turns));
  }

  const SoupSurface& surface_;
  Meetings meetings_;
  std::vector<ExactPoint> points_;
  std::map<ExactPoint, int> number_;
  std::vector<Piece> pieces_;
};

/// Convert a surface to a manifold mesh without degenerate triangles. Its vertices are rounded.
Mesh Resolved(const object::PolygonSoup& soup, Touching touching) {
  Mesh mesh = MeshOf(ResolveTouching(soup, touching));
  pmp::remove_isolated_vertices(mesh);
  pmp::remove_degenerate_faces(mesh);
  mesh.collect_garbage();
  return mesh;
}

/// Resolve touching parts.
/// Joins them, or separates them if joining makes triangles intersect. Remaining intersections are
/// removed as in RemoveCrossings.
object::PolygonSoup TidiedSoup(const object::PolygonSoup& soup) {
  for (const Touching touching : {Touching::kJoin, Touching::kPart}) {
    const Mesh mesh = Resolved(soup, touching);
    if (!pmp::does_self_intersect(mesh)) return SoupOf(mesh);
  }
  return RemoveCrossings(SoupOf(Resolved(soup, Touching::kPart))).soup;
}

}  // namespace

StageResult ArrangeSurface(const object::PolygonSoup& soup) {
  SoupSurface surface = SurfaceOf(soup);
  TurnSurfaceOutwards(surface);
  const Arrangement arrangement(surface);
  StageResult result{TidiedSoup(arrangement.Boundary())};
  result.facts["meeting_pairs"] = arrangement.pairs();
  return result;
}

}  // namespace regrasp::repair
