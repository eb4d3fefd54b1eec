#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "render/frames/body_shape.h"
#include "render/frames/shaded_mesh.h"
#include "tests/fixtures/solids.h"

namespace regrasp::render {
namespace ray_tree_test {

using Eigen::Vector3d;

TEST(RayTreeTest, RaysMeetTheNearestTriangleBeyondTheSkip) {
  const RayTree cube = MakeBodyShape(MakeCube(0.03)).rays;
  const double half = 0.5 / std::sqrt(3.0);
  const Vector3d x = Vector3d::UnitX();
  const Vector3d off_diagonal(0, 0.01, 0.02);
  EXPECT_NEAR(cube.Distance(off_diagonal, x, 1e-4), half, 1e-12);
  EXPECT_NEAR(cube.Distance(off_diagonal - half * x, x, 1e-4), 2 * half, 1e-12);
  EXPECT_TRUE(std::isinf(cube.Distance(off_diagonal + x, x, 1e-4)));
}

TEST(RayTreeTest, CountsTheSidesThatARayPasses) {
  const RayTree cube = MakeBodyShape(MakeCube(0.03)).rays;
  const Vector3d x = Vector3d::UnitX();
  const Vector3d inside(0, 0.01, 0.02);
  EXPECT_EQ(cube.CountHits(inside, x, 0, 9), 1);
  EXPECT_EQ(cube.CountHits(inside - x, x, 0, 9), 2);
  EXPECT_EQ(cube.CountHits(inside - x, x, 0, 1), 1);
  EXPECT_EQ(cube.CountHits(inside + x, x, 0, 9), 0);
}

TEST(RayTreeTest, RaysInThePlaneOfABoxSideHitTriangles) {
  ShadedMesh mesh;
  for (int i = 0; i < 16; ++i) {
    mesh.AddFlat({1.0 * i, 0, 0}, {1.0 * i, 1, 0}, {1.0 * i, 0, 1});
  }
  const RayTree tree(mesh);
  EXPECT_EQ(tree.Distance({-1, 0, 0}, Vector3d::UnitX(), 0), 1);
  EXPECT_EQ(tree.CountHits({-1, 0, 0.5}, Vector3d::UnitX(), 0, 99), 16);
}

TEST(RayTreeTest, AnEmptyTreeHasNoHits) {
  EXPECT_TRUE(std::isinf(RayTree().Distance(Vector3d::Zero(), Vector3d::UnitX(), 0)));
  EXPECT_EQ(RayTree(ShadedMesh()).CountHits(Vector3d::Zero(), Vector3d::UnitX(), 0, 9), 0);
}

TEST(RayTreeTest, GivesTheSameAsAskingEveryTriangle) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto draw = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  ShadedMesh all;
  std::vector<RayTree> alone;  // a tree of one triangle cannot omit any
  for (int i = 0; i < 300; ++i) {
    const Vector3d a = draw();
    ShadedMesh one;
    one.AddFlat(a, a + 0.4 * draw(), a + 0.4 * draw());
    all.AddFlat(one.triangles[0][0], one.triangles[0][1], one.triangles[0][2]);
    alone.emplace_back(one);
  }
  const RayTree tree(all);
  int met = 0, missed = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d origin = draw(), direction = draw().normalized();
    double nearest = std::numeric_limits<double>::infinity();
    int hits = 0;
    for (const RayTree& one : alone) {
      nearest = std::min(nearest, one.Distance(origin, direction, 0.1));
      hits += one.CountHits(origin, direction, 0.1, 1);
    }
    EXPECT_EQ(tree.Distance(origin, direction, 0.1), nearest);
    EXPECT_EQ(tree.CountHits(origin, direction, 0.1, 1000), hits);
    EXPECT_EQ(tree.CountHits(origin, direction, 0.1, 2), std::min(hits, 2));
    (hits > 0 ? met : missed) += 1;
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(missed, 20);
}

}  // namespace ray_tree_test
}  // namespace regrasp::render
