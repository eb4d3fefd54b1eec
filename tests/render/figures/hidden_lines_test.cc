#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "render/figures/solid_figure.h"
#include "render/frames/body_shape.h"
#include "tests/fixtures/solids.h"

namespace regrasp::render {
namespace hidden_lines_test {

using Eigen::Vector3d;

const Vector3d kUp = Vector3d::UnitZ();

/// Return the square [−0.2, 0.2]² at height z.
RayTree Square(double z) {
  ShadedMesh mesh;
  mesh.AddFlat({-0.2, -0.2, z}, {0.2, -0.2, z}, {0.2, 0.2, z});
  mesh.AddFlat({-0.2, -0.2, z}, {0.2, 0.2, z}, {-0.2, 0.2, z});
  return RayTree(mesh);
}

double LengthOf(const std::vector<LineSegment>& segments) {
  return std::accumulate(
      segments.begin(), segments.end(), 0.0,
      [](double sum, const LineSegment& s) { return sum + (s[1] - s[0]).norm(); });
}

TEST(HiddenLinesTest, ALineIsSplitAtTheBordersOfASurface) {
  const LineSegment line = {Vector3d(-0.5, 0.03, 0), Vector3d(0.5, 0.03, 0)};
  const LineParts parts = SplitByVisibility(Square(0.3), {&line, 1}, kUp);
  ASSERT_EQ(parts.visible.size(), 2U);
  ASSERT_EQ(parts.hidden.size(), 1U);
  EXPECT_NEAR(parts.hidden[0][0].x(), -0.2, 1e-6);
  EXPECT_NEAR(parts.hidden[0][1].x(), 0.2, 1e-6);
  EXPECT_NEAR(LengthOf(parts.visible) + LengthOf(parts.hidden), 1, 1e-12);
}

TEST(HiddenLinesTest, ASurfaceBehindALineOrBesideItHidesNothing) {
  const LineSegment line = {Vector3d(-0.5, 0.03, 0), Vector3d(0.5, 0.03, 0)};
  const LineSegment beside = {Vector3d(-0.5, 0.3, 0), Vector3d(0.5, 0.3, 0)};
  EXPECT_TRUE(SplitByVisibility(Square(-0.3), {&line, 1}, kUp).hidden.empty());
  EXPECT_TRUE(SplitByVisibility(Square(0.3), {&beside, 1}, kUp).hidden.empty());
}

TEST(HiddenLinesTest, ALineOnASurfaceIsVisible) {
  const LineSegment line = {Vector3d(-0.1, -0.1, 0), Vector3d(0.1, 0.1, 0)};
  EXPECT_TRUE(SplitByVisibility(Square(0), {&line, 1}, kUp).hidden.empty());
}

TEST(HiddenLinesTest, ThreeOfTheTwelveEdgesOfACubeAreHiddenFromEveryDirection) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  const double edge = 1 / std::sqrt(3.0);
  int views = 0;
  for (const double x : {0.3, 0.7, -0.5}) {
    for (const double z : {0.4, -0.6}) {
      const Vector3d back = Vector3d(x, 0.5, z).normalized();
      const LineParts parts = SplitByVisibility(cube.rays, cube.edges, back);
      EXPECT_NEAR(LengthOf(parts.hidden), 3 * edge, 1e-9);
      EXPECT_NEAR(LengthOf(parts.visible), 9 * edge, 1e-9);
      ++views;
    }
  }
  EXPECT_EQ(views, 6);
}

TEST(HiddenLinesTest, ASurfaceInFrontHidesAPoint) {
  EXPECT_TRUE(IsHidden(Square(0.3), {0, 0.01, 0}, kUp));
  EXPECT_FALSE(IsHidden(Square(0.3), {0, 0.01, 0.5}, kUp));
  EXPECT_FALSE(IsHidden(Square(0.3), {0, 0.01, 0}, -kUp));
}

}  // namespace hidden_lines_test
}  // namespace regrasp::render
