#include "planner/object/polyhedron.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "planner/base/error.h"

namespace regrasp {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Vector3d ClosestPointOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d d = b - a;
  const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return a + t * d;
}

/// Ericson 2005, section 5.1.5: by the Voronoi regions of vertices and edges.
Vector3d ClosestPointOnTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                const Vector3d& p) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double scale = 1 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

Vector3d TriangleVector(const std::vector<Vector3d>& v, const std::array<int, 3>& t) {
  return (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]);
}

/// Equal coordinates are one vertex; unused vertices are dropped.
PolygonSoup MergeVertices(const PolygonSoup& soup, const std::string& name) {
  PolygonSoup merged;
  std::map<std::array<double, 3>, int> index;
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    std::vector<int> facet;
    for (const int i : soup.facets[f]) {
      if (i < 0 || i >= static_cast<int>(soup.vertices.size())) {
        throw InputError(name + ": facet " + std::to_string(f) + ": vertex index " +
                         std::to_string(i) + " is out of range (" +
                         std::to_string(soup.vertices.size()) + " vertices)");
      }
      const Vector3d& v = soup.vertices[i];
      if (!v.allFinite()) {
        throw InputError(name + ": vertex " + std::to_string(i) + ": not finite");
      }
      const auto [at, is_new] =
          index.try_emplace({v.x(), v.y(), v.z()}, static_cast<int>(merged.vertices.size()));
      if (is_new) merged.vertices.push_back(v);
      facet.push_back(at->second);
    }
    merged.facets.push_back(facet);
  }
  return merged;
}

double Diameter(const std::vector<Vector3d>& vertices) {
  double largest = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest = std::max(largest, (vertices[i] - vertices[j]).squaredNorm());
    }
  }
  return std::sqrt(largest);
}

MassProperties ComputeMass(const std::vector<Vector3d>& vertices,
                           const std::vector<std::array<int, 3>>& triangles) {
  MassProperties mass;
  const Vector3d o = vertices[triangles[0][0]];
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (const auto& t : triangles) {
    const Vector3d a = vertices[t[0]] - o, b = vertices[t[1]] - o, c = vertices[t[2]] - o;
    const double volume = a.dot(b.cross(c)) / 6;
    const Vector3d sum = a + b + c;
    mass.volume += volume;
    first += volume / 4 * sum;
    second += volume / 20 *
              (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  const Vector3d centroid = first / mass.volume;
  second -= mass.volume * centroid * centroid.transpose();
  mass.centroid = centroid + o;
  mass.inertia = second.trace() * Matrix3d::Identity() - second;
  return mass;
}

}  // namespace

Polyhedron Polyhedron::FromSoup(const PolygonSoup& raw, const std::string& name) {
  const PolygonSoup soup = MergeVertices(raw, name);
  if (soup.facets.empty()) throw InputError(name + ": no facets");
  std::vector<std::array<int, 3>> triangles;
  for (const auto& facet : soup.facets) {
    for (std::size_t i = 2; i < facet.size(); ++i) {
      triangles.push_back({facet[0], facet[i - 1], facet[i]});
    }
  }
  MassProperties mass = ComputeMass(soup.vertices, triangles);
  if (mass.volume < 0) {
    for (auto& t : triangles) std::swap(t[1], t[2]);
    mass = ComputeMass(soup.vertices, triangles);
  }
  std::map<std::array<int, 2>, int> half_edges;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (!half_edges.insert({{triangles[t][k], triangles[t][(k + 1) % 3]}, int(t)}).second) {
        throw InputError(name + ": facet " + std::to_string(t) + ": not oriented or not manifold");
      }
    }
  }
  std::vector<int> face_of(triangles.size(), -1);
  std::vector<Face> faces;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (face_of[seed] >= 0) continue;
    const int id = static_cast<int>(faces.size());
    Face face;
    std::vector<int> stack{static_cast<int>(seed)};
    face_of[seed] = id;
    const Vector3d seed_normal = TriangleVector(soup.vertices, triangles[seed]).normalized();
    Vector3d area = Vector3d::Zero(), moment = Vector3d::Zero();
    while (!stack.empty()) {
      const int t = stack.back();
      stack.pop_back();
      face.triangles.push_back(t);
      const Vector3d vector = TriangleVector(soup.vertices, triangles[t]);
      area += vector / 2;
      moment += vector.norm() / 6 *
                (soup.vertices[triangles[t][0]] + soup.vertices[triangles[t][1]] +
                 soup.vertices[triangles[t][2]]);
      for (int k = 0; k < 3; ++k) {
        const auto twin = half_edges.find({triangles[t][(k + 1) % 3], triangles[t][k]});
        if (twin == half_edges.end()) {
          throw InputError(name + ": facet " + std::to_string(t) + ": not closed");
        }
        const int other = twin->second;
        if (face_of[other] >= 0) continue;
        const Vector3d n = TriangleVector(soup.vertices, triangles[other]).normalized();
        if (n.cross(seed_normal).norm() <= kCoplanarAngle && n.dot(seed_normal) > 0) {
          face_of[other] = id;
          stack.push_back(other);
        }
      }
    }
    std::ranges::sort(face.triangles);
    face.area = area.norm();
    face.inward_normal = -area.normalized();
    face.point = moment / face.area;
    faces.push_back(face);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      if (face_of[half_edges.at({b, a})] != face_of[t]) {
        faces[face_of[t]].border.push_back({a, b});
      }
    }
  }
  const double diameter = Diameter(soup.vertices);
  return Polyhedron(soup.vertices, std::move(triangles), std::move(face_of), std::move(faces),
                    diameter, mass);
}

Polyhedron::Polyhedron(std::vector<Vector3d> vertices, std::vector<std::array<int, 3>> triangles,
                       std::vector<int> face_of_triangle, std::vector<Face> faces, double diameter,
                       MassProperties mass_properties)
    : Object(diameter, std::move(mass_properties)),
      vertices_(std::move(vertices)),
      triangles_(std::move(triangles)),
      face_of_triangle_(std::move(face_of_triangle)),
      faces_(std::move(faces)) {}

Vector3d Polyhedron::inward_normal(int face) const { return faces_[face].inward_normal; }

double Polyhedron::face_measure(int face) const { return faces_[face].area; }

Vector3d Polyhedron::ClosestPoint(int face, const Vector3d& point) const {
  Vector3d closest = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const int t : faces_[face].triangles) {
    const auto& [a, b, c] = triangles_[t];
    const Vector3d candidate =
        ClosestPointOnTriangle(vertices_[a], vertices_[b], vertices_[c], point);
    const double distance = (candidate - point).squaredNorm();
    if (distance < least) {
      least = distance;
      closest = candidate;
    }
  }
  return closest;
}

std::vector<int> Polyhedron::FacesNear(const Vector3d& point, double tolerance) const {
  std::vector<std::pair<double, int>> near;
  for (int f = 0; f < face_count(); ++f) {
    const double distance = (ClosestPoint(f, point) - point).norm();
    if (distance <= tolerance) near.push_back({distance, f});
  }
  std::ranges::sort(near);
  std::vector<int> result;
  for (const auto& [distance, f] : near) result.push_back(f);
  return result;
}

double Polyhedron::DistanceToBorder(int face, const Vector3d& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : faces_[face].border) {
    least =
        std::min(least, (ClosestPointOnSegment(vertices_[a], vertices_[b], point) - point).norm());
  }
  return least;
}

bool Polyhedron::ContainsSegment(int face, const Vector3d& a, const Vector3d& b,
                                 double tolerance) const {
  // Walk in sphere steps: from a point at distance d inside its border the next d are inside too.
  const double length = (b - a).norm();
  if (length == 0) return (ClosestPoint(face, a) - a).norm() <= tolerance;
  const Vector3d along = (b - a) / length;
  for (double s = 0;;) {
    const Vector3d p = a + along * s;
    if ((ClosestPoint(face, p) - p).norm() > tolerance) return false;
    if (s >= length) return true;
    s = std::min(length, s + std::max(tolerance / 2, DistanceToBorder(face, p)));
  }
}

}  // namespace regrasp
