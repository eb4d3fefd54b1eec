#include "planner/object/polyhedron.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/object/body_measures.h"
#include "planner/object/face_tree.h"
#include "planner/object/facet_triangulation.h"
#include "planner/object/mesh_survey.h"
#include "planner/object/segment.h"
#include "planner/object/solid.h"
#include "planner/object/triangle_mesh.h"
#include "planner/object/weld.h"

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

/// Smallest length of the sum of a face's area vectors, divided by its area.
///
/// The triangles of a face have nearly equal normals, so the ratio is about 1. They cancel only if
/// the whole object consists of slivers, which join any adjacent face.
constexpr double kLeastFlatness = 0.5;

void CheckEdges(const TriangleMesh& mesh, double diameter, const std::string& name) {
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      const std::string complaint = EdgeComplaint(mesh.vertices[from], mesh.vertices[to], diameter);
      if (complaint.empty()) continue;
      throw MeshError(MeshDefect::kBadSize, name + ": " + FacetName(mesh, t) +
                                                ": the edge from vertex " + std::to_string(from) +
                                                " to vertex " + std::to_string(to) + ": " +
                                                complaint);
    }
  }
}

/// Sum up the triangles of each face. The normals are not normalized yet.
std::vector<Face> AddFacets(const TriangleMesh& mesh, const SurfaceTopology& topology,
                            const std::vector<FaceIndex>& face_of_triangle,
                            const std::vector<bool>& enclosed) {
  std::vector<Face> faces(1 + *std::ranges::max_element(face_of_triangle));
  const auto face_beyond = [&](TriangleIndex t, int k) {
    return face_of_triangle[topology.neighbor[t][k]];
  };
  // Borders take most memory of a large object, so exactly the required memory is allocated.
  std::vector<std::size_t> borders(faces.size(), 0);
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    for (int k = 0; k < 3; ++k)
      borders[face_of_triangle[t]] += face_beyond(t, k) != face_of_triangle[t];
  }
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f].borders.reserve(borders[f]);
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    Face& face = faces[face_of_triangle[t]];
    const Vector3d vector = DoubleAreaVector(mesh, t) / 2;
    face.inward_normal -= vector;
    face.measure += vector.norm();
    face.enclosed = enclosed[topology.shell[t]];
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      const FaceIndex beyond = face_beyond(t, k);
      if (beyond != face_of_triangle[t]) {
        face.borders.push_back({mesh.vertices[from], mesh.vertices[to], beyond});
      }
    }
  }
  return faces;
}

/// Make the faces of a mesh.
/// @param enclosed  for each shell, whether it is invisible from outside.
/// @throws MeshError  kBadSize if a face has no normal.
std::vector<Face> MakeFaces(const TriangleMesh& mesh, const SurfaceTopology& topology,
                            const std::vector<FaceIndex>& face_of_triangle,
                            const std::vector<bool>& enclosed, const std::string& name) {
  std::vector<Face> faces = AddFacets(mesh, topology, face_of_triangle, enclosed);
  for (FaceIndex f{0}; f < std::ssize(faces); ++f) {
    Vector3d& normal = faces[f].inward_normal;
    if (!(normal.stableNorm() > kLeastFlatness * faces[f].measure)) {
      const auto facet = std::ranges::find(face_of_triangle, f) - face_of_triangle.begin();
      throw MeshError(MeshDefect::kBadSize, name + ": " + FacetName(mesh, TriangleIndex(facet)) +
                                                ": too thin: it and its neighbours have no "
                                                "common normal");
    }
    // Adding 0 turns −0 into +0: normals are printed.
    normal = normal.stableNormalized().array() + 0.0;
  }
  for (Face& face : faces) {
    for (FaceBorder& border : face.borders) {
      border.convex = IsConvexTurn(face.inward_normal, faces[border.beyond].inward_normal,
                                   (border.b - border.a).stableNormalized());
    }
  }
  return faces;
}

double DiameterOf(const WeldedSoup& soup, const std::string& name) {
  if (soup.vertices.empty()) {
    throw MeshError(MeshDefect::kEmpty, name + ": empty: no facet with an area above 0");
  }
  const double diameter = ComputeDiameter(soup.vertices);
  const std::string complaint = SizeComplaint(soup.vertices, diameter);
  if (!complaint.empty()) {
    throw MeshError(MeshDefect::kBadSize, name + ": vertices: " + complaint);
  }
  return diameter;
}

/// A closed, consistently oriented manifold.
struct Surface {
  TriangleMesh mesh;
  SurfaceTopology topology;
  double diameter;
};

Surface MakeSurface(const WeldedSoup& soup, double diameter, const std::string& name) {
  TriangleMesh mesh = TriangulateFacets(soup, diameter, name);
  CheckEdges(mesh, diameter, name);
  SurfaceTopology topology = ComputeTopology(mesh, name);
  return {std::move(mesh), std::move(topology), diameter};
}

/// Make the surface of all shells, or of the largest one if that is the choice.
Surface MakeChosenSurface(const WeldedSoup& soup, const std::string& name, const Reading& reading) {
  std::optional<LargestShell> largest;
  if (reading.shells == Shells::kLargest) largest = FindLargestShell(soup);
  const WeldedSoup& chosen = largest ? largest->soup : soup;
  Surface surface = MakeSurface(chosen, DiameterOf(chosen, name), name);
  if (largest) reading.on_shells(largest->text);
  return surface;
}

/// Make a surface; fix defects only if the soup is not a closed manifold. A sound soup stays
/// bit-identical.
Surface MakeRepairedSurface(WeldedSoup soup, const std::string& name, const Reading& reading) {
  try {
    return MakeChosenSurface(soup, name, reading);
  } catch (const MeshError&) {
    if (!RepairSoup(soup, DiameterOf(soup, name))) throw;
  }
  return MakeChosenSurface(soup, name, reading);
}

/// Return whether SurveyMesh counts a defect.
bool IsSurveyed(MeshDefect defect) {
  switch (defect) {
    case MeshDefect::kDegenerateFacet:
    case MeshDefect::kNotPlanar:
    case MeshDefect::kNotClosed:
    case MeshDefect::kNotManifold:
    case MeshDefect::kNotOriented:
    case MeshDefect::kSelfIntersecting:
    case MeshDefect::kSeveralSolids:
      return true;
    default:
      return false;
  }
}

/// Suggest a treatment of several closed shells that helps; empty if there is none.
std::string ShellsHint(MeshDefect first, const MeshSurvey& survey, std::optional<Shells> choice) {
  if (survey.shells.size() < 2) return "";
  if (first == MeshDefect::kSeveralSolids) {
    return "; help: --shells union for one rigid body, --shells largest for the largest shell";
  }
  const bool overlap = std::ranges::any_of(survey.shells, &ClosedShell::overlaps);
  if (!overlap || survey.open_parts > 0) return "";
  return choice == Shells::kUnion ? "; --shells union requires shells that do not intersect; help: "
                                    "--repair unites them"
                                  : "; help: --shells largest keeps the largest shell";
}

/// Append the counts of all defects to the first one.
MeshError WithSurvey(const MeshError& first, const PolygonSoup& soup, const Reading& reading) {
  try {
    if (!reading.counts_defects || !IsSurveyed(first.defect())) return first;
    reading.Begin("counting defects of " + std::to_string(soup.facets.size()) + " facets");
    const MeshSurvey survey = SurveyMesh(soup, reading.deadline);
    return {first.defect(), first.what() + ("; in total " + SurveyText(survey)) +
                                ShellsHint(first.defect(), survey, reading.shells)};
  } catch (const TimeUp&) {
    return first;
  }
}

/// Mark the faces that a repair added. See PolygonSoup for the parameter `filled`.
void MarkFilled(const TriangleMesh& mesh, const std::vector<FaceIndex>& face_of_triangle,
                const std::vector<bool>& filled, std::vector<Face>& faces) {
  if (filled.empty()) return;
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    if (filled[mesh.facet_of_triangle[t]]) faces[face_of_triangle[t]].filled = true;
  }
}

}  // namespace

Polyhedron Polyhedron::FromSoup(const PolygonSoup& soup, const std::string& name,
                                const Reading& reading) {
  try {
    return Check(soup, name, reading);
  } catch (const MeshError& error) {
    throw WithSurvey(error, soup, reading);
  }
}

Polyhedron Polyhedron::Check(const PolygonSoup& soup, const std::string& name,
                             const Reading& reading) {
  const std::string facets = std::to_string(soup.facets.size()) + " facets";
  reading.Begin("checking " + facets);
  WeldedSoup welded = WeldVertices(soup, name);
  reading.Begin("triangulating " + facets);
  auto [mesh, topology, diameter] = MakeRepairedSurface(std::move(welded), name, reading);
  reading.Begin("searching intersections of " + facets);
  CheckSelfIntersection(mesh, name, reading.deadline);
  reading.Begin("joining " + facets + " to faces");
  const SolidShells shells = OrientSolid(mesh, topology, reading.shells, name);
  if (!shells.text.empty()) reading.on_shells(shells.text);
  std::vector<FaceIndex> face_of_triangle =
      JoinCoplanarFacets(mesh, topology, diameter, soup.filled);
  std::vector<Face> faces = MakeFaces(mesh, topology, face_of_triangle, shells.enclosed, name);
  MarkFilled(mesh, face_of_triangle, soup.filled, faces);
  for (Face& face : faces) {
    face.barred = face.enclosed || (face.filled && !reading.allow_filled);
  }
  topology = {};  // frees memory, which the faces of a large object need
  reading.Begin("preparing " + std::to_string(faces.size()) + " faces");
  std::optional<FeltPatch> patch = reading.patch;
  if (patch) patch->radius = patch->radius.value_or(kUsualPatch * diameter);
  return Polyhedron(std::move(mesh), std::move(face_of_triangle), std::move(faces), diameter,
                    patch);
}

Polyhedron::Polyhedron(TriangleMesh mesh, std::vector<FaceIndex> face_of_triangle,
                       std::vector<Face> faces, double diameter, std::optional<FeltPatch> patch)
    : Object(3, std::move(faces), diameter, ComputeMassProperties(mesh.vertices, mesh.triangles)),
      vertices_(std::move(mesh.vertices)),
      triangles_(std::move(mesh.triangles)),
      face_of_triangle_(std::move(face_of_triangle)),
      triangles_of_face_(face_count()),
      patch_(patch) {
  for (TriangleIndex t{0}; t < std::ssize(triangles_); ++t) {
    triangles_of_face_[face_of_triangle_[t]].push_back(t);
  }
  face_tree_ = std::make_shared<FaceTree>(*this);
}

Vector3d Polyhedron::CentroidOf(FaceIndex face) const {
  Vector3d sum = Vector3d::Zero();
  for (const TriangleIndex t : TrianglesOf(face)) {
    const Vector3d &a = vertices_[triangles_[t][0]], &b = vertices_[triangles_[t][1]],
                   &c = vertices_[triangles_[t][2]];
    const double third = (b - a).cross(c - a).norm() / 2 / 3;
    for (const Vector3d& corner : {a, b, c}) sum += third * corner;
  }
  return sum / face_measure(face);
}

Vector3d Polyhedron::ClosestPoint(FaceIndex face, const Vector3d& point) const {
  return face_tree_->ClosestPoint(*this, face, point);
}

std::vector<FaceIndex> Polyhedron::FacesNear(const Vector3d& point, double tolerance) const {
  return face_tree_->FacesNear(*this, point, tolerance);
}

std::vector<FaceIndex> Polyhedron::FacesNearSegment(const Vector3d& a, const Vector3d& b,
                                                    double tolerance) const {
  return face_tree_->FacesNearSegment(*this, a, b, tolerance);
}

double Polyhedron::DistanceToBorder(FaceIndex face, const Vector3d& point) const {
  return face_tree_->DistanceToBorder(*this, face, point);
}

bool Polyhedron::ContainsSegment(FaceIndex face, const Vector3d& a, const Vector3d& b,
                                 double tolerance) const {
  return face_tree_->ContainsSegment(*this, face, a, b, tolerance);
}

bool Polyhedron::IsRough(FaceIndex face, const Vector3d& point) const {
  if (!patch_) return false;
  const Vector3d& normal = inward_normal(face);
  const Vector3d mean = PatchNormal(*this, face, point, *patch_->radius);
  return std::atan2(normal.cross(mean).norm(), normal.dot(mean)) > patch_->most_angle;
}

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Compute the signed area of the intersection of the triangle (0, a, b) with a disc about 0.
double AreaInDisc(const Vector2d& a, const Vector2d& b, double radius_squared) {
  const auto sector = [&](const Vector2d& from, const Vector2d& to) {
    return radius_squared / 2 * std::atan2(Cross(from, to), from.dot(to));
  };
  // Intersection of the line a + t (b − a) with the circle.
  const Vector2d along = b - a;
  const double length_squared = along.squaredNorm();
  const double half = a.dot(along);
  const double root = half * half - length_squared * (a.squaredNorm() - radius_squared);
  if (!(root > 0)) return sector(a, b);
  const double enters = (-half - std::sqrt(root)) / length_squared;
  const double leaves = (-half + std::sqrt(root)) / length_squared;
  if (enters >= 1 || leaves <= 0) return sector(a, b);
  const Vector2d from = enters > 0 ? Vector2d(a + enters * along) : a;
  const Vector2d to = leaves < 1 ? Vector2d(a + leaves * along) : b;
  return (enters > 0 ? sector(a, from) : 0) + Cross(from, to) / 2 +
         (leaves < 1 ? sector(to, b) : 0);
}

/// Triangles near a point, with their adjacency.
class Neighbourhood {
 public:
  Neighbourhood(const Polyhedron& solid, const Vector3d& point, double radius)
      : solid_(solid), point_(point), radius_(radius) {
    for (const FaceIndex face : solid.FacesNear(point, radius)) {
      for (const TriangleIndex t : solid.TrianglesOf(face)) {
        if (MayMeet(t)) AddSides(t);
      }
    }
    std::ranges::sort(sides_);
  }

  /// Return the sum of area times inward normal over the triangles connected with the given one.
  [[nodiscard]] Vector3d SumFrom(TriangleIndex first) const {
    std::vector<TriangleIndex> reached = {first};
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const TriangleIndex t = reached[i];
      sum += AreaOf(t) * solid_.inward_normal(solid_.face_of_triangle(t));
      for (int k = 0; k < 3; ++k) {
        const TriangleIndex next = Beyond(t, k);
        if (next.valid() && !std::ranges::count(reached, next)) reached.push_back(next);
      }
    }
    return sum;
  }

 private:
  /// Side of a triangle, smaller vertex first.
  using Side = std::tuple<int, int, TriangleIndex>;

  [[nodiscard]] const Vector3d& Corner(TriangleIndex t, int k) const {
    return solid_.vertices()[solid_.triangles()[t][k % 3]];
  }

  [[nodiscard]] bool MayMeet(TriangleIndex t) const {
    const Vector3d low = Corner(t, 0).cwiseMin(Corner(t, 1)).cwiseMin(Corner(t, 2));
    const Vector3d high = Corner(t, 0).cwiseMax(Corner(t, 1)).cwiseMax(Corner(t, 2));
    return ((low - point_).array() <= radius_).all() && ((point_ - high).array() <= radius_).all();
  }

  [[nodiscard]] Side SideOf(TriangleIndex t, int k) const {
    const auto [low, high] =
        std::minmax(solid_.triangles()[t][k], solid_.triangles()[t][(k + 1) % 3]);
    return {low, high, t};
  }

  void AddSides(TriangleIndex t) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d at = ClosestOnSegment(Corner(t, k), Corner(t, k + 1), point_);
      if ((at - point_).norm() <= radius_) sides_.push_back(SideOf(t, k));
    }
  }

  /// Return the triangle across a side; invalid if the side is outside the ball.
  [[nodiscard]] TriangleIndex Beyond(TriangleIndex t, int k) const {
    const Side own = SideOf(t, k);
    const auto [low, high, unused] = own;
    auto at = std::ranges::lower_bound(sides_, Side{low, high, TriangleIndex(0)});
    for (; at != sides_.end() && std::get<0>(*at) == low && std::get<1>(*at) == high; ++at) {
      if (std::get<2>(*at) != t) return std::get<2>(*at);
    }
    return {};
  }

  /// Compute the area of the part of a triangle inside the ball.
  [[nodiscard]] double AreaOf(TriangleIndex t) const {
    const Vector3d& n = solid_.inward_normal(solid_.face_of_triangle(t));
    const double height = n.dot(point_ - Corner(t, 0));
    const double radius_squared = radius_ * radius_ - height * height;
    if (!(radius_squared > 0)) return 0;
    const Vector3d u = n.unitOrthogonal();
    const Vector3d v = n.cross(u);
    std::array<Vector2d, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vector3d from_point = Corner(t, k) - point_;
      corners[k] = {u.dot(from_point), v.dot(from_point)};
    }
    double area = 0;
    for (int k = 0; k < 3; ++k) {
      area += AreaInDisc(corners[k], corners[(k + 1) % 3], radius_squared);
    }
    return std::abs(area);
  }

  const Polyhedron& solid_;
  Vector3d point_;
  double radius_;
  std::vector<Side> sides_;  ///< sides that intersect the ball, sorted by vertices
};

/// Return the distance of a point from a triangle within the triangle's plane; 0 inside.
double DistanceBeside(const Polyhedron& solid, TriangleIndex t, const Vector3d& point) {
  const Vector3d& n = solid.inward_normal(solid.face_of_triangle(t));
  double farthest = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d& a = solid.vertices()[solid.triangles()[t][k]];
    const Vector3d& b = solid.vertices()[solid.triangles()[t][(k + 1) % 3]];
    // Because n points inward, the triangle is on the left of its sides as seen from outside.
    const Vector3d outwards = (b - a).cross(-n);
    const double length = outwards.norm();
    if (length > 0) farthest = std::max(farthest, outwards.dot(point - a) / length);
  }
  return farthest;
}

}  // namespace

Vector3d PatchNormal(const Polyhedron& solid, FaceIndex face, const Vector3d& point,
                     double radius) {
  if (solid.DistanceToBorder(face, point) >= radius) return solid.inward_normal(face);
  const Neighbourhood about(solid, point, radius);
  const auto& own = solid.TrianglesOf(face);
  const TriangleIndex under = *std::ranges::min_element(
      own, {}, [&](TriangleIndex t) { return DistanceBeside(solid, t, point); });
  const Vector3d sum = about.SumFrom(under);
  // The normals cancel only if the patch has two opposite sides, as a thin blade. Neither is its
  // normal.
  return sum.norm() > 0 ? Vector3d(sum.normalized()) : solid.inward_normal(face);
}

}  // namespace regrasp::object
