#include "planner/repair/cgal_mesh.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/fixtures/soups.h"

namespace regrasp::repair {
namespace surface_distance_test {

using Eigen::Vector3d;
using namespace regrasp::soups;  // NOLINT: the meshes of objects

/// Law: a hint from another point, near or far, does not change the result.
TEST(SurfaceDistance, DoesNotDependOnWhatIsFoundFirst) {
  const SurfaceDistance sphere(SphereSoup(12));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-2, 2);
  SurfaceDistance::Closest last = sphere.FindClosest({0, 0, -3});
  for (int i = 0; i < 500; ++i) {
    const Vector3d point(anywhere(random), anywhere(random), anywhere(random));
    const SurfaceDistance::Closest found = sphere.FindClosest(point, last);
    EXPECT_NEAR((found.point - point).norm(), sphere.DistanceTo(point), 1e-12);
    EXPECT_NEAR(sphere.DistanceTo(point, found), sphere.DistanceTo(point), 1e-12);
    EXPECT_GE(sphere.DistanceTo(point, last), sphere.DistanceTo(point) - 1e-12);
    last = found;
  }
}

}  // namespace surface_distance_test
}  // namespace regrasp::repair
