#include "render/frames/body_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Height of the top of a prism above the contact plane, in diameters: rays in this plane hit the
/// walls and not their rims.
constexpr double kTop = 1e-3;

/// Longest total length of a tree of creases that is removed, in diameters.
constexpr double kLongestStrayCrease = 0.3;

/// Crease angle for the shading of surfaces that are curved everywhere. A coarse scan bends by more
/// than the usual angle where its original is smooth.
constexpr double kCurvedCreaseAngle = Radians(85);

struct IndexedMesh {
  std::vector<Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices, counter-clockwise from outside

  /// Return the outward normal of a triangle, of twice its area as length.
  [[nodiscard]] Vector3d AreaNormal(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
  }
};

IndexedMesh MeshOf(const object::Polyhedron& solid) {
  return {solid.vertices(), solid.triangles()};
}

/// Return a prism below the polygon, `thickness` high in object units.
IndexedMesh MeshOf(const object::Polygon& polygon, double thickness) {
  IndexedMesh mesh;
  const double top = kTop * polygon.diameter();
  for (const double z : {top, top - thickness}) {
    for (const auto& ring : polygon.rings()) {
      for (const Eigen::Vector2d& p : ring) mesh.vertices.emplace_back(p.x(), p.y(), z);
    }
  }
  const int count = static_cast<int>(mesh.vertices.size()) / 2;
  for (const auto& [i, j, k] : object::TriangulatePolygon(polygon)) {
    mesh.triangles.push_back({i, j, k});
    mesh.triangles.push_back({i + count, k + count, j + count});
  }
  int first = 0;
  for (const auto& ring : polygon.rings()) {
    const int size = static_cast<int>(ring.size());
    for (int i = 0; i < size; ++i) {
      const int a = first + i;
      const int b = first + (i + 1) % size;
      mesh.triangles.push_back({a + count, b + count, b});
      mesh.triangles.push_back({a + count, b, a});
    }
    first += size;
  }
  return mesh;
}

std::vector<Vector3d> UnitNormals(const IndexedMesh& mesh) {
  std::vector<Vector3d> normals;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    normals.push_back(mesh.AreaNormal(t).normalized());
  }
  return normals;
}

/// Compute corner normals: the area-weighted mean over adjacent triangles within the crease angle.
ShadedMesh ShadeSmoothly(const IndexedMesh& mesh, const std::vector<Vector3d>& normals,
                         double crease_angle) {
  std::vector<std::vector<std::size_t>> around(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int vertex : mesh.triangles[t]) around[vertex].push_back(t);
  }
  const double least_cosine = std::cos(crease_angle);
  ShadedMesh surface;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vector3d, 3> corners;
    std::array<Vector3d, 3> corner_normals;
    for (int i = 0; i < 3; ++i) {
      const int vertex = mesh.triangles[t][i];
      corners[i] = mesh.vertices[vertex];
      Vector3d sum = Vector3d::Zero();
      for (const std::size_t other : around[vertex]) {
        if (normals[other].dot(normals[t]) >= least_cosine) sum += mesh.AreaNormal(other);
      }
      corner_normals[i] = sum.norm() > 0 ? Vector3d(sum.normalized()) : normals[t];
    }
    surface.Add(corners, corner_normals);
  }
  return surface;
}

/// Return the angle between the normals at an edge, radians; π if it does not have two triangles.
double AngleAt(const std::vector<std::size_t>& triangles, const std::vector<Vector3d>& normals) {
  if (triangles.size() != 2) return std::numbers::pi;
  const Vector3d& a = normals[triangles[0]];
  const Vector3d& b = normals[triangles[1]];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Remove creases that form short trees. On a coarse mesh of a round object they look like
/// scratches. Loops of any length are kept.
std::vector<std::pair<int, int>> RemoveStrayCreases(
    const IndexedMesh& mesh, const std::vector<std::pair<int, int>>& creases) {
  boost::disjoint_sets_with_storage<> joined(mesh.vertices.size());
  for (const auto& [a, b] : creases) joined.union_set(a, b);
  struct Group {
    std::set<int> vertices;
    int edges = 0;
    double length = 0;
  };
  std::map<std::size_t, Group> by_root;
  for (const auto& [a, b] : creases) {
    Group& group = by_root[joined.find_set(a)];
    group.vertices.insert({a, b});
    ++group.edges;
    group.length += (mesh.vertices[a] - mesh.vertices[b]).norm();
  }
  std::vector<std::pair<int, int>> kept;
  std::ranges::copy_if(creases, std::back_inserter(kept), [&](const auto& edge) {
    const Group& group = by_root[joined.find_set(edge.first)];
    const bool is_tree = group.edges < static_cast<int>(group.vertices.size());
    return !is_tree || group.length > kLongestStrayCrease;
  });
  return kept;
}

/// Triangles at each edge, by the indices of its ends.
using EdgeTriangles = std::map<std::pair<int, int>, std::vector<std::size_t>>;

/// Return whether the second triangle at an edge is below the plane of the first.
bool IsConvex(const IndexedMesh& mesh, const std::pair<int, int>& edge,
              const std::vector<std::size_t>& triangles) {
  for (const int vertex : mesh.triangles[triangles[1]]) {
    if (vertex == edge.first || vertex == edge.second) continue;
    const Vector3d above = mesh.vertices[vertex] - mesh.vertices[edge.first];
    return mesh.AreaNormal(triangles[0]).dot(above) < 0;
  }
  return false;
}

EdgeTriangles TrianglesAtEdges(const IndexedMesh& mesh) {
  EdgeTriangles triangles_of_edge;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    for (const auto& edge : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)}) {
      triangles_of_edge[edge].push_back(t);
    }
  }
  return triangles_of_edge;
}

/// Return whether a surface is curved nearly everywhere, like a scan. Its few sharp edges are
/// accidents of the triangulation and would look like scratches. A CAD model has many edges within
/// its planar faces, or bends sharply at most of its edges.
bool IsCurvedEverywhere(const EdgeTriangles& edges, const std::vector<Vector3d>& normals,
                        double crease_angle) {
  constexpr double kLeastBendShare = 0.9, kLeastCreaseShare = 0.25;
  std::size_t inner = 0, folds = 0, creases = 0;
  for (const auto& [edge, triangles] : edges) {
    const double angle = AngleAt(triangles, normals);
    const bool has_two = triangles.size() == 2;
    if (has_two) ++inner;
    if (has_two && angle > object::kCoplanarAngle) ++folds;
    if (angle > crease_angle) ++creases;
  }
  return static_cast<double>(folds) > kLeastBendShare * static_cast<double>(inner) &&
         static_cast<double>(creases) < kLeastCreaseShare * static_cast<double>(folds);
}

/// @param curved  whether the surface is curved everywhere (IsCurvedEverywhere).
void AddEdges(const IndexedMesh& mesh, const EdgeTriangles& edges,
              const std::vector<Vector3d>& normals, const BodyOptions& options, bool curved,
              BodyShape& shape) {
  const bool all = options.edges == EdgeStyle::kAll;
  const double least = all ? object::kCoplanarAngle : options.crease_angle;
  const auto ends = [&](const std::pair<int, int>& edge) {
    return std::array<Vector3d, 2>{mesh.vertices[edge.first], mesh.vertices[edge.second]};
  };
  std::vector<std::pair<int, int>> creases;
  for (const auto& [edge, triangles] : edges) {
    const double angle = AngleAt(triangles, normals);
    if (angle > least) creases.push_back(edge);
    if (angle > object::kCoplanarAngle && triangles.size() == 2 &&
        IsConvex(mesh, edge, triangles)) {
      shape.folds.push_back({ends(edge), {normals[triangles[0]], normals[triangles[1]]}});
    }
  }
  if (!all && curved) return;
  for (const auto& edge : all ? creases : RemoveStrayCreases(mesh, creases)) {
    shape.edges.push_back(ends(edge));
  }
}

}  // namespace

BodyShape MakeBodyShape(const object::Object& object, const BodyOptions& options) {
  const auto* polygon = dynamic_cast<const object::Polygon*>(&object);
  IndexedMesh mesh = polygon != nullptr ? MeshOf(*polygon, options.thickness * object.diameter())
                                        : MeshOf(dynamic_cast<const object::Polyhedron&>(object));
  for (Vector3d& p : mesh.vertices) {
    p = (p - object.mass_properties().centroid) / object.diameter();
  }
  const std::vector<Vector3d> normals = UnitNormals(mesh);
  BodyShape shape;
  const EdgeTriangles edges = TrianglesAtEdges(mesh);
  const bool curved = IsCurvedEverywhere(edges, normals, options.crease_angle);
  shape.surface = ShadeSmoothly(mesh, normals, curved ? kCurvedCreaseAngle : options.crease_angle);
  shape.rays = RayTree(shape.surface);
  if (options.edges != EdgeStyle::kNone) {
    AddEdges(mesh, edges, normals, options, curved, shape);
    if (curved) shape.shell = MakeShell(shape.surface, kEdgeWidth);
  }
  return shape;
}

}  // namespace regrasp::render
