#include "render/frames/viewpoint.h"

#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace viewpoint_test {

using Eigen::Vector3d;

/// Return a finger on the face of [−half, half]³ with the outward normal `outward`.
FingerGlyph MakeGlyph(int finger, const Vector3d& outward, double half) {
  FingerGlyph glyph;
  glyph.finger = FingerIndex(finger);
  glyph.contact = half * outward;
  glyph.outward = outward;
  glyph.fingertip_radius = 0.03;
  glyph.fingertip = glyph.contact + glyph.fingertip_radius * outward;
  glyph.stem_radius = 0.013;
  glyph.stem_end = glyph.end = glyph.contact + 0.125 * outward;
  glyph.force = Vector3d::Zero();
  return glyph;
}

TEST(ViewpointTest, ADirectionIsAzimuthAboutZAndElevationAboveThePlane) {
  EXPECT_LT((ViewDirection{0, 0}.ToCamera() - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((ViewDirection{Radians(90), 0}.ToCamera() - Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((ViewDirection{1.0, Radians(90)}.ToCamera() - Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(ViewpointTest, IsOnTheSideOfTheFingers) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  const double half = 0.5 / std::sqrt(3.0);
  for (const Vector3d& side :
       {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-1, 0, 0), Vector3d(0, -1, 0)}) {
    const Vector3d back = ChooseViewpoints(cube, false, {{MakeGlyph(0, side, half)}}, 0).common;
    EXPECT_GT(back.dot(side), 0.1);
    EXPECT_LT(back.dot(side), 0.9) << "along the stem";
    EXPECT_GT(back.z(), 0);
  }
}

TEST(ViewpointTest, CountsAFingerInEveryFrame) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  const double half = 0.5 / std::sqrt(3.0);
  const FingerGlyph front = MakeGlyph(0, Vector3d::UnitX(), half);
  const FingerGlyph behind = MakeGlyph(1, -Vector3d::UnitX(), half);
  EXPECT_GT(ChooseViewpoints(cube, false, {{front}, {front}, {behind}}, 0).common.x(), 0);
  EXPECT_LT(ChooseViewpoints(cube, false, {{front}, {behind}, {behind}}, 0).common.x(), 0);
}

TEST(ViewpointTest, SeesAPlanarObjectFromStraightAbove) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  const FingerGlyph away = MakeGlyph(0, -Vector3d::UnitZ(), 0.5 / std::sqrt(3.0));
  const Viewpoints chosen = ChooseViewpoints(cube, true, {{away}}, 0);
  EXPECT_EQ(chosen.common, Vector3d(Vector3d::UnitZ()));
  EXPECT_FALSE(chosen.own[0]);
}

TEST(ViewpointTest, ShowsForcesFromTheSide) {
  const BodyShape plate = MakeBodyShape(MakeBox({0.06, 0.06, 0.004}));
  FingerGlyph pushed = MakeGlyph(0, Vector3d::UnitZ(), 0.02);
  for (const int axis : {0, 1}) {
    pushed.force = Vector3d::Unit(axis);
    const Vector3d back = ChooseViewpoints(plate, false, {{pushed}}, 1).common;
    EXPECT_LT(std::abs(back[axis]), std::abs(back[1 - axis]));
  }
}

/// Return the candidate directions of the camera, except those from below.
std::vector<Vector3d> AllAround() {
  std::vector<Vector3d> directions;
  for (const double elevation : {12, 20, 28, 38, 48}) {
    for (int i = 0; i < 36; ++i) {
      directions.push_back(ViewDirection{Radians(10.0 * i + 3), Radians(elevation)}.ToCamera());
    }
  }
  return directions;
}

/// Check that exactly the faulty frames have their own view, for frames for AllAround.
/// @param make  function that returns the fingers of a frame that are invisible from a direction.
template <class Make>
void ExpectOwnViewsOnlyAlong(const BodyShape& body, const Make& make) {
  const std::vector<Vector3d> directions = AllAround();
  std::vector<std::vector<FingerGlyph>> frames;
  for (const Vector3d& direction : directions) frames.push_back(make(direction));
  const Viewpoints chosen = ChooseViewpoints(body, false, frames, 1);
  int own = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double along = directions[i].dot(chosen.common);
    if (along > std::cos(Radians(5))) {
      EXPECT_TRUE(chosen.own[i]) << along;
    }
    if (!chosen.own[i]) continue;
    EXPECT_GT(along, std::cos(Radians(40)));
    EXPECT_LT(directions[i].dot(*chosen.own[i]), 0.95);
    ++own;
  }
  EXPECT_GT(own, 0);
}

TEST(ViewpointTest, AFrameWithAFingerBehindAThickBodyHasAViewOfItsOwn) {
  BodyShape sphere;
  sphere.surface = MakeCapsule(Vector3d::Zero(), Vector3d::Zero(), 0.5);
  sphere.rays = RayTree(sphere.surface);
  ExpectOwnViewsOnlyAlong(sphere, [](const Vector3d& direction) {
    FingerGlyph behind = MakeGlyph(0, -direction, 0.5);
    behind.force = direction;
    return std::vector<FingerGlyph>{behind};
  });
}

TEST(ViewpointTest, AFrameWhoseFingersCoverEachOtherInsideARingHasAViewOfItsOwn) {
  const BodyShape ring = MakeBodyShape(MakeHoledBlock());
  ExpectOwnViewsOnlyAlong(ring, [](const Vector3d& direction) {
    std::vector<FingerGlyph> pair = {MakeGlyph(0, Vector3d::UnitZ(), 0),
                                     MakeGlyph(1, Vector3d::UnitZ(), 0)};
    for (FingerGlyph& glyph : pair) {
      const Vector3d by = (glyph.finger == 0 ? 0.1 : -0.1) * direction;
      for (Vector3d* p : {&glyph.contact, &glyph.fingertip, &glyph.stem_end, &glyph.end}) *p += by;
    }
    return pair;
  });
}

TEST(ViewpointTest, OnACubeOneViewServesAllFrames) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  const double half = 0.5 / std::sqrt(3.0);
  std::vector<std::vector<FingerGlyph>> frames;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d a = Vector3d::Unit(axis), b = Vector3d::Unit((axis + 1) % 3);
    frames.push_back({MakeGlyph(0, a, half), MakeGlyph(1, -a, half), MakeGlyph(2, b, half),
                      MakeGlyph(3, -b, half)});
  }
  const Viewpoints chosen = ChooseViewpoints(cube, false, frames, 0);
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_FALSE(chosen.own[i]) << i;
}

}  // namespace viewpoint_test
}  // namespace regrasp::render
