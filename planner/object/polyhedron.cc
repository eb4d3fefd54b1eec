#include "planner/object/polyhedron.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

#include "planner/object/closest_on_segment.h"
#include "planner/object/diameter.h"
#include "planner/object/face_joining.h"
#include "planner/object/face_tree.h"
#include "planner/object/facet_triangulation.h"
#include "planner/object/self_intersection.h"
#include "planner/object/size_limits.h"
#include "planner/object/solid.h"
#include "planner/object/surface_topology.h"
#include "planner/object/weld.h"

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

/// The facets of a face point the same way, so their areas add up as vectors do. Only where all of
/// a body is slivers, which join whatever lies beside them, do they cancel.
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

/// Areas and borders of the faces.
/// @throws MeshError  kBadSize where a face has no normal.
std::vector<Polyhedron::Face> CollectFaces(const TriangleMesh& mesh,
                                           const SurfaceTopology& topology,
                                           const std::vector<FaceIndex>& face_of_triangle,
                                           const std::string& name) {
  std::vector<Polyhedron::Face> faces(1 + *std::ranges::max_element(face_of_triangle));
  std::vector<Vector3d> area_vectors(faces.size(), Vector3d::Zero());
  for (auto& face : faces) {
    face.point = Vector3d::Zero();
    face.area = 0;
  }
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    Polyhedron::Face& face = faces[face_of_triangle[t]];
    face.triangles.push_back(t);
    const Vector3d vector = DoubleAreaVector(mesh, t) / 2;
    const double area = vector.norm();
    area_vectors[face_of_triangle[t]] += vector;
    face.area += area;
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      face.point += area / 3 * mesh.vertices[from];
      const FaceIndex beyond = face_of_triangle[topology.neighbor[t][k]];
      if (beyond != face_of_triangle[t]) {
        face.border.push_back({from, to});
        face.beyond.push_back(beyond);
      }
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!(area_vectors[f].stableNorm() > kLeastFlatness * faces[f].area)) {
      throw MeshError(MeshDefect::kBadSize,
                      name + ": " + FacetName(mesh, faces[f].triangles.front()) +
                          ": too thin: it and its neighbours have no common normal");
    }
    faces[f].point /= faces[f].area;
    // Adding 0 turns −0 into +0: normals are printed.
    faces[f].inward_normal = (-area_vectors[f].stableNormalized()).array() + 0.0;
  }
  return faces;
}

}  // namespace

Polyhedron Polyhedron::FromSoup(const PolygonSoup& soup, const std::string& name,
                                const Reading& reading) {
  const std::string facets = std::to_string(soup.facets.size()) + " facets";
  reading.Begin("checking " + facets);
  const WeldedSoup welded = WeldVertices(soup, name);
  const double diameter = ComputeDiameter(welded.vertices);
  if (const std::string complaint = SizeComplaint(welded.vertices, diameter); !complaint.empty()) {
    throw MeshError(MeshDefect::kBadSize, name + ": vertices: " + complaint);
  }
  reading.Begin("triangulating " + facets);
  TriangleMesh mesh = TriangulateFacets(welded, diameter, name);
  CheckEdges(mesh, diameter, name);
  SurfaceTopology topology = ComputeTopology(mesh, name);
  reading.Begin("looking for intersections of " + facets);
  CheckSelfIntersection(mesh, name, reading.deadline);
  reading.Begin("joining " + facets + " to faces");
  const int outside = OrientSolid(mesh, topology, name);
  std::vector<FaceIndex> face_of_triangle = JoinCoplanarFacets(mesh, topology, diameter);
  std::vector<Face> faces = CollectFaces(mesh, topology, face_of_triangle, name);
  for (Face& face : faces) face.enclosed = topology.shell[face.triangles.front()] != outside;
  reading.Begin("preparing " + std::to_string(faces.size()) + " faces");
  const MassProperties mass = ComputeMassProperties(mesh.vertices, mesh.triangles);
  return Polyhedron(std::move(mesh.vertices), std::move(mesh.triangles),
                    std::move(face_of_triangle), std::move(faces), diameter, mass);
}

Polyhedron::Polyhedron(std::vector<Vector3d> vertices, std::vector<std::array<int, 3>> triangles,
                       std::vector<FaceIndex> face_of_triangle, std::vector<Face> faces,
                       double diameter, MassProperties mass_properties)
    : Object(diameter, std::move(mass_properties)),
      vertices_(std::move(vertices)),
      triangles_(std::move(triangles)),
      face_of_triangle_(std::move(face_of_triangle)),
      faces_(std::move(faces)),
      face_tree_(std::make_shared<FaceTree>(vertices_, triangles_, faces_, diameter)) {}

Vector3d Polyhedron::inward_normal(FaceIndex face) const { return faces_[face].inward_normal; }

double Polyhedron::face_measure(FaceIndex face) const { return faces_[face].area; }

Vector3d Polyhedron::ClosestPoint(FaceIndex face, const Vector3d& point) const {
  return face_tree_->ClosestPoint(face, point);
}

std::vector<FaceIndex> Polyhedron::FacesNear(const Vector3d& point, double tolerance) const {
  return face_tree_->FacesNear(point, tolerance);
}

std::vector<FaceIndex> Polyhedron::FacesNearSegment(const Vector3d& a, const Vector3d& b,
                                                    double tolerance) const {
  return face_tree_->FacesNearSegment(a, b, tolerance);
}

double Polyhedron::DistanceToBorder(FaceIndex face, const Vector3d& point) const {
  return face_tree_->DistanceToBorder(face, point);
}

bool Polyhedron::ContainsSegment(FaceIndex face, const Vector3d& a, const Vector3d& b,
                                 double tolerance) const {
  return face_tree_->ContainsSegment(face, a, b, tolerance);
}

std::vector<FaceBorder> Polyhedron::BordersOf(FaceIndex face) const {
  const Face& own = faces_[face];
  std::vector<FaceBorder> borders;
  borders.reserve(own.border.size());
  for (std::size_t i = 0; i < own.border.size(); ++i) {
    const Vector3d& a = vertices_[own.border[i][0]];
    const Vector3d& b = vertices_[own.border[i][1]];
    const Vector3d& normal = faces_[own.beyond[i]].inward_normal;
    borders.push_back(
        {a, b, own.beyond[i], IsConvexTurn(own.inward_normal, normal, (b - a).stableNormalized())});
  }
  return borders;
}

bool Polyhedron::AreNeighbours(FaceIndex face, FaceIndex other) const {
  return std::ranges::find(faces_[face].beyond, other) != faces_[face].beyond.end();
}

std::vector<Vector3d> Polyhedron::CommonPoints(FaceIndex face, FaceIndex other,
                                               const Vector3d& point, double tolerance) const {
  std::vector<Vector3d> points;
  const auto add = [&](const Vector3d& p) {
    if ((p - point).norm() <= tolerance) points.push_back(p);
  };
  std::set<int> corners;
  const Face& own = faces_[face];
  for (std::size_t i = 0; i < own.border.size(); ++i) {
    const Vector3d& a = vertices_[own.border[i][0]];
    if (own.beyond[i] == other) add(ClosestOnSegment(a, vertices_[own.border[i][1]], point));
    // Every corner of a border is where one of its segments begins.
    if ((a - point).norm() <= tolerance) corners.insert(own.border[i][0]);
  }
  if (corners.empty()) return points;
  for (const auto& [from, to] : faces_[other].border) {
    if (corners.contains(from)) add(vertices_[from]);
  }
  return points;
}

}  // namespace regrasp::object
