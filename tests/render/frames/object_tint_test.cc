#include "render/frames/object_tint.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace regrasp::render {
namespace object_tint_test {

using Eigen::Vector3d;

/// Return the colour of a surface with this normal.
Color ColorAlong(const Vector3d& normal) {
  ShadedMesh mesh;
  const Vector3d n = normal.normalized();
  mesh.Add({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}, {n, n, n});
  TintByDirection(mesh);
  EXPECT_EQ(mesh.colors.size(), 1u);
  return mesh.colors[0][2];
}

TEST(ObjectTintTest, EachSideOfABoxHasItsOwnPaleColour) {
  std::set<std::tuple<int, int, int>> colors;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Color color = ColorAlong(sign * Vector3d::Unit(axis));
      EXPECT_GT(color.r + color.g + color.b, 600);
      colors.emplace(color.r, color.g, color.b);
    }
  }
  EXPECT_EQ(colors.size(), 6u);
}

TEST(ObjectTintTest, ColoursChangeContinuously) {
  Color before = ColorAlong({1, 0, 0});
  for (int i = 1; i <= 360; ++i) {
    const double turn = i * M_PI / 180;
    const Color color = ColorAlong({std::cos(turn), std::sin(turn), 0.3 * std::sin(2 * turn)});
    EXPECT_LE(std::abs(color.r - before.r), 12) << i;
    EXPECT_LE(std::abs(color.g - before.g), 12) << i;
    before = color;
  }
}

}  // namespace object_tint_test
}  // namespace regrasp::render
