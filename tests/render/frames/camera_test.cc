#include "render/frames/camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

namespace regrasp::render {
namespace camera_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<Vector3d> RandomPoints(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({uniform(random), uniform(random), uniform(random)});
  }
  return points;
}

TEST(CameraTest, CroppingIsSymmetricAndPreservesTheProjection) {
  std::mt19937 random(5);
  const Margins margins = {0.05, 0.04, 0.10};
  int cropped = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vector3d> points = RandomPoints(random, 12);
    for (Vector3d& point : points) point.z() *= 0.1;
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      const Camera whole =
          FitCamera(CameraAxes(Vector3d(1, 0.2, 0.3)), projection, 801, 600, margins, points);
      const Camera camera = Crop(whole, margins, points, 400, 300);
      const Vector2d off((801 - camera.width) / 2.0, (600 - camera.height) / 2.0);
      EXPECT_GE(camera.height, 300);
      for (const Vector3d& point : points) {
        const Vector2d p = camera.Project(point);
        EXPECT_LT((p + off - whole.Project(point)).norm(), 1e-9);
        EXPECT_GE(p.x(), 0.05 * 600 - 1e-6);
        EXPECT_LE(p.x(), camera.width - 0.05 * 600 + 1e-6);
        EXPECT_GE(p.y(), 0.04 * 600 - 1e-6);
        EXPECT_LE(p.y(), camera.height - 0.10 * 600 + 1e-6);
      }
      cropped += camera.height < 600;
    }
  }
  EXPECT_GT(cropped, 150);
}

TEST(CameraTest, AxesAreARightHandedFrameWithZUp) {
  std::mt19937 random(1);
  for (const Vector3d& back : RandomPoints(random, 50)) {
    const Eigen::Matrix3d axes = CameraAxes(back);
    EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-12));
    EXPECT_NEAR(axes.determinant(), 1, 1e-12);
    EXPECT_GT(axes.col(1).z(), 0);
    EXPECT_NEAR(axes.col(0).z(), 0, 1e-12);
  }
}

TEST(CameraTest, FitsAllPointsIntoTheMarginsAndTouchesThem) {
  std::mt19937 random(2);
  constexpr int kWidth = 800;
  constexpr int kHeight = 500;
  const Margins margins = {0.05, 0.04, 0.10};
  int tight = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<Vector3d> points = RandomPoints(random, 12);
    const Vector3d back = RandomPoints(random, 1).front();
    const Camera camera =
        FitCamera(CameraAxes(back), Projection::kPerspective, kWidth, kHeight, margins, points);
    Vector2d low(1e9, 1e9);
    Vector2d high(-1e9, -1e9);
    for (const Vector3d& point : points) {
      EXPECT_GT(camera.Depth(point), 0);
      low = low.cwiseMin(camera.Project(point));
      high = high.cwiseMax(camera.Project(point));
    }
    constexpr double kPixel = 1e-6;
    EXPECT_GE(low.x(), 0.05 * kHeight - kPixel);
    EXPECT_LE(high.x(), kWidth - 0.05 * kHeight + kPixel);
    EXPECT_GE(low.y(), 0.04 * kHeight - kPixel);
    EXPECT_LE(high.y(), 0.90 * kHeight + kPixel);
    const double room_x = low.x() - 0.05 * kHeight;
    const double room_y = low.y() - 0.04 * kHeight;
    tight += std::min(room_x, room_y) < kPixel ? 1 : 0;
  }
  EXPECT_EQ(tight, 200);
}

TEST(CameraTest, AnOrthographicCameraFitsTheSameMarginsWithOneScaleAtEveryDepth) {
  std::mt19937 random(5);
  constexpr int kWidth = 800, kHeight = 500;
  const Margins margins = {0.05, 0.04, 0.10};
  int tight = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<Vector3d> points = RandomPoints(random, 12);
    const Eigen::Matrix3d axes = CameraAxes(RandomPoints(random, 1).front());
    const Camera camera =
        FitCamera(axes, Projection::kOrthographic, kWidth, kHeight, margins, points);
    Eigen::AlignedBox2d box;
    for (const Vector3d& point : points) {
      EXPECT_GT(camera.Depth(point), 0);
      box.extend(camera.Project(point));
      EXPECT_DOUBLE_EQ(camera.PixelsPerUnit(point), camera.PixelsPerUnit(points[0]));
      EXPECT_EQ(camera.ToEye(point), axes.col(2));
    }
    constexpr double kPixel = 1e-6;
    EXPECT_GE(box.min().x(), 0.05 * kHeight - kPixel);
    EXPECT_LE(box.max().x(), kWidth - 0.05 * kHeight + kPixel);
    EXPECT_GE(box.min().y(), 0.04 * kHeight - kPixel);
    EXPECT_LE(box.max().y(), 0.90 * kHeight + kPixel);
    const double left = box.min().x() - 0.05 * kHeight, above = box.min().y() - 0.04 * kHeight;
    tight += std::min(left, above) < kPixel ? 1 : 0;
  }
  EXPECT_EQ(tight, 100);
}

TEST(CameraTest, ProjectsTheCentreOfItsViewToTheCentreOfTheImage) {
  Camera camera;
  camera.position = {0, 0, 5};
  camera.half_height = 0.5;
  camera.width = 200;
  camera.height = 100;
  EXPECT_TRUE(camera.Project(Vector3d::Zero()).isApprox(Vector2d(100, 50)));
  // At distance 5 the upper border is at 2.5.
  EXPECT_TRUE(camera.Project({0, 2.5, 0}).isApprox(Vector2d(100, 0)));
  EXPECT_DOUBLE_EQ(camera.PixelsPerUnit(Vector3d::Zero()), 20);
}

}  // namespace camera_test
}  // namespace regrasp::render
