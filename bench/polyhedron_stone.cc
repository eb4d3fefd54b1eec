#include "bench/polyhedron_stone.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace regrasp {

using Eigen::Vector3d;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Maximum displacement of the points off the spiral, over their mean distance.
constexpr double kJitter = 0.3;

std::vector<Vector3d> SpreadNormals(int count, unsigned seed) {
  std::mt19937 engine(seed);
  // The standard library's distributions differ between implementations; this one does not.
  const auto draw = [&] { return kJitter * (2.0 * engine() / std::mt19937::max() - 1); };
  const double spacing = std::sqrt(4 * std::numbers::pi / count);
  std::vector<Vector3d> normals;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count;
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));  // golden angle
    const double r = std::sqrt(1 - z * z);
    const Vector3d on_spiral(r * std::cos(angle), r * std::sin(angle), z);
    Vector3d moved = on_spiral;
    for (int axis = 0; axis < 3; ++axis) moved[axis] += spacing * draw();
    normals.push_back(moved.normalized());
  }
  return normals;
}

Vector3d ToEigen(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

object::Polyhedron MakeStone(int faces, const Vector3d& stretch, unsigned seed) {
  // Poles of the planes: vertices of the solid are triangles of their hull, and its faces are the
  // hull's vertices.
  std::vector<Kernel::Point_3> poles;
  for (const Vector3d& n : SpreadNormals(faces, seed)) poles.emplace_back(n.x(), n.y(), n.z());
  Mesh hull;
  CGAL::convex_hull_3(poles.begin(), poles.end(), hull);
  object::PolygonSoup soup;
  std::vector<int> vertex_of(hull.number_of_faces());
  for (const Mesh::Face_index facet : hull.faces()) {
    Eigen::Matrix3d planes;
    int row = 0;
    for (const Mesh::Vertex_index v : hull.vertices_around_face(hull.halfedge(facet))) {
      planes.row(row++) = ToEigen(hull.point(v)).transpose();
    }
    vertex_of[facet] = static_cast<int>(soup.vertices.size());
    const Vector3d vertex = planes.partialPivLu().solve(Vector3d::Ones());
    soup.vertices.push_back(vertex.cwiseProduct(stretch));
  }
  for (const Mesh::Vertex_index v : hull.vertices()) {
    std::vector<int> corners;  // clockwise from outside
    for (const Mesh::Face_index facet : hull.faces_around_target(hull.halfedge(v))) {
      corners.push_back(vertex_of[facet]);
    }
    std::ranges::reverse(corners);
    soup.facets.push_back(std::move(corners));
  }
  return object::Polyhedron::FromSoup(soup, "stone");
}

}  // namespace regrasp
