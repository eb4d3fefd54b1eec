#include "render/frames/mesh_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace mesh_detail_test {

using Eigen::Vector3d;

/// Return the cube [−1, 1]³ with n × n squares on each face, for a power of two.
ShadedMesh FineCube(int n) {
  ShadedMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      const Vector3d normal = sign * Vector3d::Unit(axis), u = Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = normal.cross(u);
      const auto at = [&](int i, int j) -> Vector3d {
        return normal + (2.0 * i / n - 1) * u + (2.0 * j / n - 1) * v;
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          mesh.AddFlat(at(i, j), at(i + 1, j), at(i + 1, j + 1));
          mesh.AddFlat(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
      }
    }
  }
  return mesh;
}

/// Return the fine cube, projected onto the unit sphere with smooth normals.
ShadedMesh Sphere() {
  ShadedMesh mesh = FineCube(16);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (Vector3d& p : mesh.triangles[t]) p.normalize();
    mesh.normals[t] = mesh.triangles[t];
  }
  return mesh;
}

/// Return the number of directed edges without an opposite edge.
int OpenEdges(const ShadedMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& [a, b, c] : Weld(mesh).triangles) {
    for (const auto& edge : {std::pair(a, b), {b, c}, {c, a}}) ++edges[edge];
  }
  return static_cast<int>(std::ranges::count_if(edges, [&](const auto& entry) {
    const auto& [edge, count] = entry;
    const auto opposite = edges.find({edge.second, edge.first});
    return opposite == edges.end() || opposite->second != count;
  }));
}

TEST(ReduceDetail, AFineCubeBecomesItsTwelveTriangles) {
  const ShadedMesh reduced = ReduceDetail(FineCube(8), 0);
  ASSERT_EQ(reduced.triangles.size(), 12U);
  EXPECT_NEAR(Volume(reduced), 8, 1e-12);
  for (std::size_t t = 0; t < reduced.triangles.size(); ++t) {
    const auto& [a, b, c] = reduced.triangles[t];
    const Vector3d across = (b - a).cross(c - a).normalized();
    for (const Vector3d& normal : reduced.normals[t]) EXPECT_NEAR(across.dot(normal), 1, 1e-12);
  }
}

TEST(ReduceDetail, ASphereKeepsItsShapeWithinTheTolerance) {
  const ShadedMesh sphere = Sphere();
  EXPECT_EQ(ReduceDetail(sphere, 0).triangles.size(), sphere.triangles.size());
  std::size_t previous = sphere.triangles.size();
  for (const double tolerance : {0.01, 0.03}) {
    const ShadedMesh reduced = ReduceDetail(sphere, tolerance);
    EXPECT_LT(reduced.triangles.size(), previous);
    previous = reduced.triangles.size();
    EXPECT_EQ(OpenEdges(reduced), 0);
    for (std::size_t t = 0; t < reduced.triangles.size(); ++t) {
      const auto& [a, b, c] = reduced.triangles[t];
      EXPECT_GT(((a + b + c) / 3).norm(), 1 - 3 * tolerance);
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(reduced.triangles[t][i].norm(), 1, 1e-12);
        EXPECT_NEAR(reduced.normals[t][i].dot(reduced.triangles[t][i]), 1, 1e-9);
      }
    }
  }
}

TEST(ReduceDetail, OpenBordersRemain) {
  // A plate with a square hole: its border is open, and its surface is planar.
  ShadedMesh plate;
  constexpr int kSide = 8;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      if (i == 3 && j == 3) continue;
      const Vector3d p(i, j, 0), u = Vector3d::UnitX(), v = Vector3d::UnitY();
      plate.AddFlat(p, p + u, p + u + v);
      plate.AddFlat(p, p + u + v, p + v);
    }
  }
  const auto area = [](const ShadedMesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) sum += (b - a).cross(c - a).z() / 2;
    return sum;
  };
  const ShadedMesh reduced = ReduceDetail(plate, 0.1);
  EXPECT_LT(reduced.triangles.size(), plate.triangles.size() / 4);
  EXPECT_NEAR(area(reduced), kSide * kSide - 1, 1e-12);
}

TEST(ReduceDetail, IsDeterministicAndKeepsColouredMeshes) {
  const ShadedMesh sphere = Sphere();
  EXPECT_EQ(ReduceDetail(sphere, 0.02).triangles, ReduceDetail(sphere, 0.02).triangles);
  ShadedMesh colored = sphere;
  colored.colors.assign(colored.triangles.size(), {kWhite, kWhite, kWhite});
  EXPECT_EQ(ReduceDetail(colored, 0.02).triangles.size(), sphere.triangles.size());
}

}  // namespace mesh_detail_test
}  // namespace regrasp::render
