#include "render/frames/body_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "planner/base/angle.h"
#include "planner/object/polygon.h"
#include "planner/object/polygon_triangulation.h"
#include "planner/object/polyhedron.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Faces that meet at a smaller angle than this look like one: no edge is drawn.
constexpr double kFeatureAngle = Radians(5);

/// The top of a prism above the plane of the contacts, in diameters: rays in that plane meet the
/// walls and not their rims.
constexpr double kTop = 1e-3;

/// Where a wedge lies above the plane of the contacts: on the prism's top, clear of it in the depth
/// buffer, and below the middle of a force arrow's surface.
constexpr double kWedgeBottom = 1.8e-3, kWedgeTop = 2.6e-3;

/// Segments of the cone's rim: its outline is within 0.1 % of a circle.
constexpr int kConeSegments = 72;

/// Moves points of the object to the shape's frame.
struct Normaliser {
  Vector3d centroid;
  double diameter;
  Vector3d operator()(const Vector3d& p) const { return (p - centroid) / diameter; }
};

BodyShape MakeSolidShape(const object::Polyhedron& body, const Normaliser& place) {
  BodyShape shape;
  const std::vector<Vector3d>& vertices = body.vertices();
  for (const auto& [a, b, c] : body.triangles()) {
    shape.surface.AddFlat(place(vertices[a]), place(vertices[b]), place(vertices[c]));
  }
  std::map<std::pair<int, int>, std::vector<FaceIndex>> faces_of_edge;
  for (FaceIndex face{0}; face < body.face_count(); ++face) {
    for (const auto& [a, b] : body.faces()[face].border) {
      faces_of_edge[std::minmax(a, b)].push_back(face);
    }
  }
  for (const auto& [edge, faces] : faces_of_edge) {
    const Vector3d n = body.inward_normal(faces.front());
    const double cosine = n.dot(body.inward_normal(faces.back()));
    if (faces.size() == 2 && cosine > std::cos(kFeatureAngle)) continue;
    shape.edges.push_back({place(vertices[edge.first]), place(vertices[edge.second])});
  }
  return shape;
}

BodyShape MakePrismShape(const object::Polygon& polygon, double thickness,
                         const Normaliser& place) {
  BodyShape shape;
  const Vector3d top = kTop * Vector3d::UnitZ();
  const Vector3d bottom = top - thickness * Vector3d::UnitZ();
  std::vector<Vector3d> vertices;
  for (const auto& ring : polygon.rings()) {
    for (const Eigen::Vector2d& p : ring) vertices.push_back(place(Vector3d(p.x(), p.y(), 0)));
  }
  for (const auto& [i, j, k] : object::TriangulatePolygon(polygon)) {
    const std::array<Vector3d, 3> p = {vertices[i], vertices[j], vertices[k]};
    shape.surface.AddFlat(p[0] + top, p[1] + top, p[2] + top);
    shape.surface.AddFlat(p[0] + bottom, p[2] + bottom, p[1] + bottom);
  }
  for (FaceIndex face{0}; face < polygon.face_count(); ++face) {
    const auto [from, to] = polygon.edge(face);
    const Vector3d a = place(from);
    const Vector3d b = place(to);
    shape.surface.AddFlat(a + bottom, b + bottom, b + top);
    shape.surface.AddFlat(a + bottom, b + top, a + top);
    shape.edges.push_back({a + bottom, b + bottom});
    shape.edges.push_back({a + top, b + top});
    shape.edges.push_back({a + bottom, a + top});
  }
  return shape;
}

}  // namespace

void FacetMesh::AddFlat(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  triangles.push_back({a, b, c});
  normals.push_back({normal, normal, normal});
}

FacetMesh TurnInsideOut(FacetMesh mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    std::swap(mesh.normals[i][1], mesh.normals[i][2]);
    for (Vector3d& normal : mesh.normals[i]) normal = -normal;
  }
  return mesh;
}

BodyShape MakeBodyShape(const object::Object& object, double thickness) {
  const Normaliser place = {object.mass_properties().centroid, object.diameter()};
  if (const auto* polygon = dynamic_cast<const object::Polygon*>(&object)) {
    return MakePrismShape(*polygon, thickness, place);
  }
  return MakeSolidShape(dynamic_cast<const object::Polyhedron&>(object), place);
}

FacetMesh MakeCone(double half_angle, double slant) {
  FacetMesh cone;
  const double sine = std::sin(half_angle);
  const double cosine = std::cos(half_angle);
  const auto rim = [&](double i) -> Vector3d {
    const double angle = 2 * std::numbers::pi * i / kConeSegments;
    return slant * Vector3d(sine * std::cos(angle), sine * std::sin(angle), cosine);
  };
  const auto normal = [&](double i) -> Vector3d {
    const double angle = 2 * std::numbers::pi * i / kConeSegments;
    return {cosine * std::cos(angle), cosine * std::sin(angle), -sine};
  };
  for (int i = 0; i < kConeSegments; ++i) {
    cone.triangles.push_back({Vector3d::Zero(), rim(i + 1), rim(i)});
    cone.normals.push_back({normal(i + 0.5), normal(i + 1), normal(i)});
    cone.AddFlat({0, 0, slant * cosine}, rim(i), rim(i + 1));
  }
  return cone;
}

FacetMesh MakeWedge(double half_angle, double slant) {
  FacetMesh wedge;
  const double x = slant * std::sin(half_angle);
  const double z = slant * std::cos(half_angle);
  const std::array<Vector3d, 3> corners = {Vector3d::Zero(), Vector3d(x, 0, z), Vector3d(-x, 0, z)};
  const Vector3d low = kWedgeBottom * Vector3d::UnitY(), high = kWedgeTop * Vector3d::UnitY();
  const auto& [a, b, c] = corners;
  wedge.AddFlat(a + high, c + high, b + high);
  wedge.AddFlat(a + low, b + low, c + low);
  for (int i = 0; i < 3; ++i) {
    const Vector3d& p = corners[i];
    const Vector3d& q = corners[(i + 1) % 3];
    wedge.AddFlat(p + low, p + high, q + high);
    wedge.AddFlat(p + low, q + high, q + low);
  }
  return wedge;
}

double RayDistance(const FacetMesh& mesh, const Vector3d& origin, const Vector3d& direction,
                   double skip) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    // Möller and Trumbore 1997.
    const Vector3d u = b - a;
    const Vector3d v = c - a;
    const Vector3d p = direction.cross(v);
    const double determinant = u.dot(p);
    if (determinant == 0) continue;
    const Vector3d s = origin - a;
    const double alpha = s.dot(p) / determinant;
    const Vector3d q = s.cross(u);
    const double beta = direction.dot(q) / determinant;
    const double distance = v.dot(q) / determinant;
    const bool inside = alpha >= 0 && beta >= 0 && alpha + beta <= 1;
    if (inside && distance > skip) nearest = std::min(nearest, distance);
  }
  return nearest;
}

}  // namespace regrasp::render
