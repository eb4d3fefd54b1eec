#include "planner/collision/surface_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"
#include "planner/object/object.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::collision {
namespace surface_tree_test {

using Eigen::Vector3d;

/// Comparison with a linear search over all triangles.
TEST(SurfaceTreeTest, DistancesAreThoseOfAllTriangles) {
  for (const char* name : {"models/mug500.obj", "models/l_block.obj"}) {
    const object::ObjectFile file = object::ReadObject(ProjectPath(name));
    const auto& solid = dynamic_cast<const object::Polyhedron&>(*file.object);
    constexpr double kScale = 0.5;
    const SurfaceTree tree(solid, kScale);
    RandomStream random(5, RandomUse::kCandidates);
    int apart = 0;
    for (int i = 0; i < 200; ++i) {
      ConvexShape shape;
      const Vector3d place = 0.03 * Vector3d(random.Normal(), random.Normal(), random.Normal());
      const int points = 1 + static_cast<int>(random.Index(6));
      for (int j = 0; j < points; ++j) {
        shape.points.push_back(place +
                               0.01 * Vector3d(random.Normal(), random.Normal(), random.Normal()));
      }
      shape.radius = 0.005 * random.Uniform();
      double expected = 1;
      for (const auto& corners : solid.triangles()) {
        ConvexShape triangle;
        for (const int corner : corners) {
          triangle.points.push_back(kScale * solid.vertices()[corner]);
        }
        expected = std::min(expected, Distance(shape, triangle).lower);
      }
      ASSERT_NEAR(tree.DistanceFrom(shape, 1), expected, 1e-9);
      ASSERT_NEAR(tree.DistanceFrom(shape, 0.01), std::min(expected, 0.01), 1e-9);
      ASSERT_EQ(tree.IsApart(shape, 0.01), expected > 0.01);
      const PosedShape posed{&shape, Eigen::Isometry3d::Identity(), BoundingSphereOf(shape)};
      ASSERT_EQ(tree.IsApart(posed, 0.01), expected > 0.01);
      apart += static_cast<int>(expected > 0.01);
    }
    EXPECT_GT(apart, 20);
    EXPECT_LT(apart, 180);
  }
}

}  // namespace surface_tree_test
}  // namespace regrasp::collision
