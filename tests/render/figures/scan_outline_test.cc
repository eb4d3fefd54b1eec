#include "render/figures/scan_outline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/frames/shaded_mesh.h"

namespace regrasp::render {
namespace scan_outline_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Pixels per unit and middle of the panel.
constexpr double kScale = 100;
const Vector2d kMiddle(100, 100);

/// Return a camera that looks along −z.
PanelCamera FromAbove() {
  return {Eigen::Matrix3d::Identity(), kScale, {-kMiddle.x() / kScale, kMiddle.y() / kScale}};
}

ShadedMesh Sphere(const Vector3d& centre, double radius) {
  return MakeCapsule(centre, centre, radius);
}

double Length(const Polyline& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

bool IsClosed(const Polyline& line) { return (line.front() - line.back()).norm() < 1e-9; }

TEST(ScanOutline, ASphereHasItsRimAndNothingElse) {
  const ScanOutline outline = TraceScan(Sphere({0, 0, 0}, 0.4), FromAbove());
  ASSERT_EQ(outline.areas.size(), 1U);
  ASSERT_EQ(outline.lines.size(), 1U);
  EXPECT_TRUE(IsClosed(outline.lines[0]));
  const double around = 2 * std::numbers::pi * 0.4 * kScale;
  EXPECT_NEAR(Length(outline.lines[0]), around, 0.02 * around);
  for (const Vector2d& p : outline.lines[0]) EXPECT_NEAR((p - kMiddle).norm(), 40, 0.6);
}

TEST(ScanOutline, AnOutlineInFrontOfTheSurfaceIsCompleteAndOneBehindItIsHidden) {
  ShadedMesh both = Sphere({0, 0, 0}, 0.4);
  const ShadedMesh small = Sphere({0.1, 0, 0.8}, 0.1);
  const auto add = [&both](const ShadedMesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      both.Add(mesh.triangles[t], mesh.normals[t]);
    }
  };
  add(small);
  const ScanOutline front = TraceScan(both, FromAbove());
  ASSERT_EQ(front.lines.size(), 2U);
  for (const Polyline& line : front.lines) EXPECT_TRUE(IsClosed(line));
  EXPECT_EQ(front.areas.size(), 1U);
  PanelCamera from_below = FromAbove();
  from_below.axes.col(1) *= -1;
  from_below.axes.col(2) *= -1;
  EXPECT_EQ(TraceScan(both, from_below).lines.size(), 1U);
}

TEST(ScanOutline, AShallowDentHasNoLineAndAHoleHasOne) {
  // A square sheet with a bump of a hundredth of a diameter, and a frame around a hole.
  ShadedMesh sheet;
  sheet.AddFlat({-0.4, -0.4, 0}, {0.4, -0.4, 0}, {0.4, 0.4, 0});
  sheet.AddFlat({-0.4, -0.4, 0}, {0.4, 0.4, 0}, {-0.4, 0.4, 0});
  sheet.AddFlat({-0.1, -0.1, 0.01}, {0.1, -0.1, 0.01}, {0.1, 0.1, 0.01});
  EXPECT_EQ(TraceScan(sheet, FromAbove()).lines.size(), 1U);
  ShadedMesh frame;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(i * std::numbers::pi / 2, Vector3d::UnitZ()).toRotationMatrix();
    const Vector3d a = turn * Vector3d(-0.4, -0.4, 0), b = turn * Vector3d(0.4, -0.4, 0);
    const Vector3d c = turn * Vector3d(0.2, -0.2, 0), d = turn * Vector3d(-0.2, -0.2, 0);
    frame.AddFlat(a, b, c);
    frame.AddFlat(a, c, d);
  }
  const ScanOutline outline = TraceScan(frame, FromAbove());
  EXPECT_EQ(outline.lines.size(), 2U);
  EXPECT_EQ(outline.areas.size(), 2U);
}

TEST(ScanOutline, NoSurfaceHasNoLines) {
  const ScanOutline outline = TraceScan({}, FromAbove());
  EXPECT_TRUE(outline.areas.empty() && outline.lines.empty());
}

}  // namespace scan_outline_test
}  // namespace regrasp::render
