#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "planner/base/random.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/moved.h"

namespace regrasp::roadmap {

inline Eigen::Vector3d DrawDirection(RandomStream& random) {
  const double z = 2 * random.Uniform() - 1;
  const double turn = 2 * std::numbers::pi * random.Uniform();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// Return the convex hull of points on an ellipsoid of a few centimetres, with 2 · corners − 4
/// triangles.
/// The triangles are the triples of points that have all other points on their inner side.
inline object::Polyhedron MakeConvexBody(int corners, std::uint64_t seed,
                                         const Eigen::Vector3d& axes = {0.05, 0.03, 0.04}) {
  RandomStream random(seed, RandomUse::kContactPoints);
  object::PolygonSoup soup;
  while (std::ssize(soup.vertices) < corners) {
    soup.vertices.push_back(DrawDirection(random).cwiseProduct(axes));
  }
  const auto& v = soup.vertices;
  const auto add_if_facet = [&](int a, int b, int c) {
    const Eigen::Vector3d normal = (v[b] - v[a]).cross(v[c] - v[a]);
    int before = 0;
    for (int d = 0; d < corners; ++d) {
      if (d != a && d != b && d != c && normal.dot(v[d] - v[a]) > 0) ++before;
    }
    if (before == 0) soup.facets.push_back({a, b, c});
    if (before == corners - 3) soup.facets.push_back({a, c, b});
  };
  for (int a = 0; a < corners; ++a) {
    for (int b = a + 1; b < corners; ++b) {
      for (int c = b + 1; c < corners; ++c) add_if_facet(a, b, c);
    }
  }
  return object::Polyhedron::FromSoup(soup, "convex body");
}

inline std::vector<grasp::Contact> Centroids(const object::Polyhedron& solid) {
  std::vector<grasp::Contact> contacts;
  for (object::TriangleIndex i{0}; i < std::ssize(solid.triangles()); ++i) {
    const auto& [a, b, c] = solid.triangles()[i];
    const auto& v = solid.vertices();
    const FaceIndex face = solid.face_of_triangle(i);
    contacts.push_back({(v[a] + v[b] + v[c]) / 3, solid.inward_normal(face), face});
  }
  return contacts;
}

/// Read a mesh of models/ by its name.
inline object::Polyhedron ReadMesh(const std::string& name) {
  return ReadSolidModel(name + ".obj");
}

}  // namespace regrasp::roadmap
