#include "planner/object/triangle_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace regrasp::object {
namespace triangle_tree_test {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// Return `count` small triangles on a spiral, each with a different first corner.
std::vector<Corners> Spiral(int count) {
  std::vector<Corners> triangles;
  for (int i = 0; i < count; ++i) {
    const Vector3d at(std::cos(0.3 * i), std::sin(0.3 * i), 0.01 * i);
    triangles.push_back({at, at + 0.02 * Vector3d::UnitX(), at + 0.03 * Vector3d::UnitY()});
  }
  return triangles;
}

AlignedBox3d BoxOf(const Corners& triangle) {
  AlignedBox3d box;
  for (const Vector3d& corner : triangle) box.extend(corner);
  return box;
}

const auto kEnterAll = [](const AlignedBox3d&) { return true; };

TEST(TriangleTree, VisitsEachTriangleOnce) {
  for (const int count : {0, 1, 2, 3, 7, 100}) {
    for (const int capacity : {1, 2, 4}) {
      const TriangleTree tree(Spiral(count), capacity);
      double height = 0;
      int visits = 0;
      tree.Visit(kEnterAll, [&](const Corners& triangle) {
        height += triangle[0].z();
        ++visits;
        return true;
      });
      EXPECT_EQ(visits, count);
      EXPECT_NEAR(height, 0.01 * count * (count - 1) / 2, 1e-9);
    }
  }
}

TEST(TriangleTree, FindsWhatAFullSearchFinds) {
  const std::vector<Corners> triangles = Spiral(200);
  const TriangleTree tree(triangles, 2);
  int pruned_visits = 0;
  for (int query = 0; query < 50; ++query) {
    const Vector3d point(std::cos(1.7 * query), std::sin(2.3 * query), 0.04 * query);
    double expected = std::numeric_limits<double>::infinity();
    for (const Corners& triangle : triangles) {
      expected = std::min(expected, BoxOf(triangle).exteriorDistance(point));
    }
    double nearest = std::numeric_limits<double>::infinity();
    tree.Visit([&](const AlignedBox3d& box) { return box.exteriorDistance(point) < nearest; },
               [&](const Corners& triangle) {
                 nearest = std::min(nearest, BoxOf(triangle).exteriorDistance(point));
                 ++pruned_visits;
                 return true;
               });
    EXPECT_EQ(nearest, expected);
  }
  EXPECT_LT(pruned_visits, 50 * 200 / 4);
}

TEST(TriangleTree, VisitEndsWhenTheCallerStops) {
  const TriangleTree tree(Spiral(100), 4);
  int visits = 0;
  tree.Visit(kEnterAll, [&](const Corners&) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

TEST(TriangleTree, PrunedRootHasNoVisits) {
  const TriangleTree tree(Spiral(100), 4);
  tree.Visit([](const AlignedBox3d&) { return false; },
             [](const Corners&) {
               ADD_FAILURE();
               return true;
             });
}

TEST(TriangleTree, ManyEqualTrianglesAreHalved) {
  const TriangleTree tree(std::vector<Corners>(5000, Spiral(1)[0]), 1);
  int visits = 0;
  tree.Visit(kEnterAll, [&](const Corners&) { return ++visits > 0; });
  EXPECT_EQ(visits, 5000);
}

}  // namespace triangle_tree_test
}  // namespace regrasp::object
