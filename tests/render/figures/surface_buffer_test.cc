#include "render/figures/surface_buffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace regrasp::render {
namespace surface_buffer_test {

using Eigen::Vector3d;

constexpr int kSide = 40;

/// Return the square [low, high]² at depth z.
ShadedMesh Square(double low, double high, double z) {
  ShadedMesh mesh;
  mesh.AddFlat({low, low, z}, {high, low, z}, {high, high, z});
  mesh.AddFlat({low, low, z}, {high, high, z}, {low, high, z});
  return mesh;
}

void Add(const ShadedMesh& mesh, int label, SurfaceBuffer& buffer, double lift = 0) {
  buffer.Add(
      mesh, label, [](const Vector3d& p) { return p; }, Eigen::Matrix3d::Identity(), lift);
}

int CountLabel(const SurfaceBuffer& buffer, int label) {
  int count = 0;
  for (int y = 0; y < buffer.height(); ++y) {
    for (int x = 0; x < buffer.width(); ++x) count += buffer.LabelAt(x, y) == label ? 1 : 0;
  }
  return count;
}

TEST(SurfaceBuffer, TheNearestSurfaceIsVisibleInAnyOrder) {
  for (const bool near_first : {false, true}) {
    SurfaceBuffer buffer(kSide, kSide);
    for (const bool near : {near_first, !near_first}) {
      near ? Add(Square(10, 20, 5), 1, buffer) : Add(Square(0, kSide, 0), 0, buffer);
    }
    EXPECT_EQ(CountLabel(buffer, 1), 100);
    EXPECT_EQ(CountLabel(buffer, 0), kSide * kSide - 100);
    EXPECT_EQ(buffer.DepthAt(15, 15), 5);
    EXPECT_NEAR(buffer.NormalAt(15, 15).z(), 1, 0.01);
  }
}

TEST(SurfaceBuffer, ALiftDecidesBetweenNearlyEqualSurfaces) {
  SurfaceBuffer buffer(kSide, kSide);
  Add(Square(10, 20, 0), 1, buffer, 1);
  Add(Square(0, kSide, 0.5), 0, buffer);
  EXPECT_EQ(CountLabel(buffer, 1), 100);
}

TEST(SurfaceBuffer, SurfacesOutsideTheImageAndWithoutAreaAreInvisible) {
  SurfaceBuffer buffer(kSide, kSide);
  Add(Square(-30, -1, 0), 0, buffer);
  Add(Square(1e6, 2e6, 0), 0, buffer);
  ShadedMesh flat;
  flat.Add({Vector3d(0, 0, 0), Vector3d(9, 9, 0), Vector3d(20, 20, 5)},
           {Vector3d::UnitX(), Vector3d::UnitX(), Vector3d::UnitX()});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  flat.Add({Vector3d(nan, 0, 0), Vector3d(9, 0, 0), Vector3d(0, 20, 5)},
           {Vector3d::UnitX(), Vector3d::UnitX(), Vector3d::UnitX()});
  Add(flat, 0, buffer);
  EXPECT_EQ(CountLabel(buffer, SurfaceBuffer::kNothing), kSide * kSide);
  EXPECT_EQ(buffer.LabelAt(-1, 0), SurfaceBuffer::kNothing);
  EXPECT_EQ(buffer.LabelAt(0, kSide), SurfaceBuffer::kNothing);
}

TEST(SurfaceBuffer, SpecksDisappearAndLargePartsStay) {
  SurfaceBuffer buffer(kSide, kSide);
  Add(Square(0, kSide, 0), 0, buffer);
  Add(Square(10, 12, 9), 1, buffer);
  Add(Square(20, 30, 9), 2, buffer);
  ASSERT_EQ(CountLabel(buffer, 1), 4);
  SurfaceBuffer fine = buffer;
  fine.RemoveSpecks(20);  // no step is so large
  EXPECT_EQ(CountLabel(fine, 1), 4);
  buffer.RemoveSpecks(2);
  EXPECT_EQ(CountLabel(buffer, 1), 0);
  EXPECT_GE(CountLabel(buffer, 2), 88);  // corners become round
}

}  // namespace surface_buffer_test
}  // namespace regrasp::render
