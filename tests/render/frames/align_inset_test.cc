#include <gtest/gtest.h>

#include <vector>

#include "planner/base/number.h"
#include "render/frames/annotation.h"
#include "render/frames/frame.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace align_inset_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

Camera MakeCamera() {
  Camera camera = {.axes = CameraAxes(Vector3d(1, 0.3, 0.5)), .half_height = 0.15};
  camera.position = 5 * camera.axes.col(2);
  camera.width = 640;
  camera.height = 480;
  return camera;
}

const TextStyle kStyle = {12, {}};

/// Return a finger on the side x = 0.3 that slid by `length` along y.
FingerGlyph MakeMoved(double length) {
  FingerGlyph glyph;
  glyph.role = plan::FingerRole::kMoved;
  glyph.outward = Vector3d::UnitX();
  glyph.contact = Vector3d(0.3, 0, 0);
  glyph.fingertip_radius = 0.03;
  glyph.stem_radius = 0.01;
  glyph.fingertip = glyph.contact + glyph.fingertip_radius * glyph.outward;
  glyph.stem_end = glyph.end = glyph.contact + 0.12 * glyph.outward;
  glyph.path = {glyph.contact - Vector3d(0, length, 0), glyph.contact};
  glyph.force = Vector3d::Zero();
  return glyph;
}

TEST(AlignInsetTest, OnlySlidingStepsShorterThanAFingertipAreMagnified) {
  const auto count = [](const FingerGlyph& glyph) {
    return PlaceInsets(MakeCamera(), {&glyph, 1}, {}, kStyle).size();
  };
  EXPECT_EQ(count(MakeMoved(0.059)), 1U);
  EXPECT_EQ(count(MakeMoved(0.061)), 0U);
  EXPECT_EQ(count(MakeMoved(0)), 0U);
  FingerGlyph holding = MakeMoved(0.02);
  holding.role = plan::FingerRole::kHolding;
  EXPECT_EQ(count(holding), 0U);
}

TEST(AlignInsetTest, ItIsOmittedIfItDoesNotDoubleTheMotion) {
  const FingerGlyph glyph = MakeMoved(0.05);
  const double magnification =
      PlaceInsets(MakeCamera(), {&glyph, 1}, {}, kStyle).at(0).magnification;
  for (const double of_inset : {1.95, 2.05}) {
    Camera camera = MakeCamera();
    camera.half_height *= of_inset / magnification;
    EXPECT_EQ(PlaceInsets(camera, {&glyph, 1}, {}, kStyle).size(), of_inset < 2 ? 0U : 1U);
  }
}

TEST(AlignInsetTest, ItIsInsideTheImageAndCentredAtThePath) {
  int checked = 0;
  for (const double length : {0.05, 0.01, 0.002}) {
    const FingerGlyph glyph = MakeMoved(length);
    const Camera camera = MakeCamera();
    const AlignInset inset = PlaceInsets(camera, {&glyph, 1}, {}, kStyle).at(0);
    const Vector3d middle = (glyph.path.front() + glyph.contact) / 2;
    EXPECT_LT((inset.camera.Project(middle) - inset.centre).norm(), 1e-6);
    const double before =
        (camera.Project(glyph.path.front()) - camera.Project(glyph.contact)).norm();
    const double after =
        (inset.camera.Project(glyph.path.front()) - inset.camera.Project(glyph.contact)).norm();
    EXPECT_NEAR(after / before, inset.magnification, 0.02 * inset.magnification);
    EXPECT_LT(after, 2 * inset.radius);
    EXPECT_GT(inset.magnification, 1);
    for (int axis : {0, 1}) {
      EXPECT_GT(inset.centre[axis], inset.radius);
      EXPECT_LT(inset.centre[axis], (axis == 0 ? 640 : 480) - inset.radius);
    }
    EXPECT_GT((inset.centre - camera.Project(glyph.fingertip)).norm(), inset.radius);
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

TEST(AlignInsetTest, AFrameWithAShortSlidingStepShowsItsStart) {
  // The same grasp with and without a sliding step: the difference is much larger than a track
  // below the fingertip.
  const object::Polyhedron cube = MakeCube(0.03);
  const auto count = [&](double length) {
    plan::Snapshot moved = MakeCubeSequence()[0];
    plan::FingerState& finger = moved.fingers[0];
    const FrameOptions options = {640, 480, 1};
    FrameRenderer renderer(cube, 1, Radians(20), {moved}, options);
    const Image before = renderer.Render(moved);
    finger.role = plan::FingerRole::kMoved;
    finger.path_W = {finger.contact_W - Vector3d(0, length, 0), finger.contact_W};
    const Image after = renderer.Render(moved);
    int different = 0;
    for (std::size_t i = 0; i < before.rgb.size(); ++i) different += before.rgb[i] != after.rgb[i];
    return different;
  };
  EXPECT_GT(count(0.0005), 8000);
  EXPECT_EQ(count(0), 0);
}

TEST(AlignInsetTest, OrdinalsAreDrawnOnlyIfFingersStartAtDifferentTimes) {
  const object::Polyhedron cube = MakeCube(0.03);
  // Finger 2 slides in the first or in the second segment. The images differ in nothing but the
  // ordinals.
  const auto draw = [&](bool later) {
    plan::Snapshot snapshot = MakeCubeSequence()[0];
    const FrameOptions options = {640, 480, 1};
    for (const int i : {0, 2}) {
      plan::FingerState& finger = snapshot.fingers[i];
      finger.role = plan::FingerRole::kMoved;
      const Vector3d start = finger.contact_W - Vector3d(0, 0.015, 0);
      const bool waits = i == 2 && later;
      finger.path_W = {start, waits ? start : finger.contact_W, finger.contact_W};
    }
    FrameRenderer renderer(cube, 1, Radians(20), {snapshot}, options);
    return renderer.Render(snapshot);
  };
  const Image together = draw(false), one_by_one = draw(true);
  int different = 0;
  for (std::size_t i = 0; i < together.rgb.size(); ++i) {
    different += together.rgb[i] != one_by_one.rgb[i];
  }
  EXPECT_GT(different, 300);
}

}  // namespace align_inset_test
}  // namespace regrasp::render
