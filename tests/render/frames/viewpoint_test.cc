#include "render/frames/viewpoint.h"

#include <gtest/gtest.h>

#include "planner/base/angle.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace {

using Eigen::Vector3d;

/// A finger on the face of [−half, half]³ that `outward` points out of.
FingerGlyph MakeGlyph(int finger, const Vector3d& outward, double half) {
  FingerGlyph glyph;
  glyph.finger = FingerIndex(finger);
  glyph.contact = half * outward;
  glyph.outward = outward;
  glyph.ball_radius = 0.03;
  glyph.ball = glyph.contact + glyph.ball_radius * outward;
  glyph.stem_end = glyph.end = glyph.contact + 0.125 * outward;
  return glyph;
}

TEST(ViewpointTest, ADirectionIsAzimuthAboutZAndElevationAboveThePlane) {
  EXPECT_LT((ViewDirection{0, 0}.ToCamera() - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((ViewDirection{Radians(90), 0}.ToCamera() - Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((ViewDirection{1.0, Radians(90)}.ToCamera() - Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(ViewpointTest, StandsOnTheSideOfTheFingers) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  const double half = 0.5 / std::sqrt(3.0);
  for (const Vector3d& side :
       {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-1, 0, 0), Vector3d(0, -1, 0)}) {
    const Vector3d back = ChooseViewpoint(cube, false, {{MakeGlyph(0, side, half)}});
    EXPECT_GT(back.dot(side), 0.1);
    EXPECT_LT(back.dot(side), 0.9) << "along the stem";
    EXPECT_GT(back.z(), 0);
  }
}

TEST(ViewpointTest, CountsAFingerAsOftenAsItIsSeenInTheSequence) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  const double half = 0.5 / std::sqrt(3.0);
  const FingerGlyph front = MakeGlyph(0, Vector3d::UnitX(), half);
  const FingerGlyph behind = MakeGlyph(1, -Vector3d::UnitX(), half);
  EXPECT_GT(ChooseViewpoint(cube, false, {{front}, {front}, {behind}}).x(), 0);
  EXPECT_LT(ChooseViewpoint(cube, false, {{front}, {behind}, {behind}}).x(), 0);
}

TEST(ViewpointTest, SeesAPlanarObjectFromStraightAbove) {
  const BodyShape cube = MakeBodyShape(MakeCube(0.03));
  EXPECT_EQ(ChooseViewpoint(cube, true, {}), Vector3d(Vector3d::UnitZ()));
}

}  // namespace
}  // namespace regrasp::render
