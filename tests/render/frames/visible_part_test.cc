#include "render/frames/visible_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/number.h"

namespace regrasp::render {
namespace visible_part_test {

using Eigen::Vector3d;

/// Add the 12 triangles of a cube.
void AddCube(const Vector3d& centre, double half, ShadedMesh& mesh) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      const Vector3d normal = sign * Vector3d::Unit(axis), u = Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = normal.cross(u);
      const auto at = [&](int x, int y) -> Vector3d {
        return centre + half * (normal + x * u + y * v);
      };
      mesh.AddFlat(at(-1, -1), at(1, -1), at(1, 1));
      mesh.AddFlat(at(-1, -1), at(1, 1), at(-1, 1));
    }
  }
}

/// Return the number of triangles whose corners are all within `half` of the origin in x.
int CountWithin(const ShadedMesh& mesh, double half) {
  return static_cast<int>(std::ranges::count_if(mesh.triangles, [&](const auto& corners) {
    return std::ranges::all_of(corners, [&](const Vector3d& p) { return std::abs(p.x()) < half; });
  }));
}

ShelledMesh Seen(const ShadedMesh& mesh, const std::vector<Vector3d>& eyes) {
  OffscreenContext context(kVisibleSide, kVisibleSide);
  return VisiblePart({mesh, MakeShell(mesh, 0.05)}, eyes, 0.02, context);
}

TEST(VisiblePartTest, TrianglesInsideAnotherSurfaceAreOmitted) {
  ShadedMesh mesh;
  AddCube({0, 0, 0}, 1, mesh);
  AddCube({0, 0, 0}, 0.5, mesh);
  const ShelledMesh seen = Seen(mesh, {{8, 7, 6}, {-7, -8, -6}});
  EXPECT_EQ(CountWithin(mesh, 0.9), 12);
  EXPECT_EQ(CountWithin(seen.mesh, 0.9), 0);
  EXPECT_EQ(CountWithin(seen.shell, 0.9), 0);
  EXPECT_EQ(seen.mesh.triangles.size(), 12);
  EXPECT_GT(seen.shell.triangles.size(), 6);
}

TEST(VisiblePartTest, ASurfaceThatNoEyeSeesIsOmitted) {
  ShadedMesh mesh;
  AddCube({0, 0, 0}, 1, mesh);
  AddCube({3, 0, 0}, 0.5, mesh);
  // The large cube hides the small one from the first eye only.
  // It sees one face, whose corners belong to all triangles of the adjacent faces.
  EXPECT_EQ(Seen(mesh, {{-40, 0, 0}}).mesh.triangles.size(), 10);
  EXPECT_GT(Seen(mesh, {{-40, 0, 0}, {0, 40, 0}}).mesh.triangles.size(), 12);
  EXPECT_TRUE(Seen(mesh, {}).mesh.triangles.empty());
}

TEST(VisiblePartTest, ChosenEyesAreWithinTheAngleOfAllOthers) {
  std::vector<Vector3d> eyes;
  for (int degrees = 0; degrees < 90; ++degrees) {
    eyes.emplace_back(10 * std::cos(Radians(degrees)), 10 * std::sin(Radians(degrees)), 0);
  }
  EXPECT_EQ(ChooseEyes(eyes, Vector3d::Zero(), Radians(6.5)).size(), 13);
  EXPECT_EQ(ChooseEyes(eyes, Vector3d::Zero(), Radians(0.5)).size(), eyes.size());
  EXPECT_EQ(ChooseEyes({}, Vector3d::Zero(), Radians(6)).size(), 0);
}

}  // namespace visible_part_test
}  // namespace regrasp::render
