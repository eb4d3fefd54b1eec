#include "render/frames/fault_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <vector>

#include "planner/base/number.h"
#include "render/frames/annotation.h"
#include "render/frames/frame.h"
#include "render/picture/cairo_paint.h"
#include "tests/fixtures/solids.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace fault_marks_test {

using Eigen::Vector3d;
using plan::Fault;
using plan::Reason;

constexpr int kFinger = 2;

/// Return a finger at distance `away` from the face +x of [−1, 1]³, and another one in contact.
FaultScene OffSurface(double away) {
  plan::Snapshot snapshot;
  snapshot.fingers = {MakeFinger(kFinger, plan::FingerRole::kHolding, {1 + away, 0, 0}, {-1, 0, 0}),
                      MakeFinger(0, plan::FingerRole::kHolding, {-1, 0, 0}, {1, 0, 0})};
  const Fault fault = {.fingers = {FingerIndex(kFinger)},
                       .found = grasp::Contact{{1 + away, 0, 0}, {-1, 0, 0}},
                       .expected = {{{1, 0, 0}, {-1, 0, 0}}}};
  return MakeFaultScene(MakeCube(), 1, Reason::kOffSurface, fault, snapshot, "the reason");
}

TEST(FaultScene, VisibleDistancesAreDrawnToScale) {
  const FaultScene scene = OffSurface(0.5);
  ASSERT_EQ(scene.marks.dimensions.size(), 1u);
  EXPECT_EQ(scene.marks.dimensions[0].text, "50 cm");
  EXPECT_LT((scene.marks.dimensions[0].from - Vector3d(1, 0, 0)).norm(), 1e-9);
  EXPECT_LT((scene.marks.dimensions[0].to - Vector3d(1.5, 0, 0)).norm(), 1e-9);
  EXPECT_EQ(scene.marks.heading, "the reason");
}

TEST(FaultScene, AFingerNearOrFarOffTheSurfaceIsDrawnBesideIt) {
  const double D = MakeCube().diameter();
  for (const double away : {0.01, 10.0, 4e3, 1e9, 1e200}) {
    const FaultScene scene = OffSurface(away);
    ASSERT_EQ(scene.snapshot.fingers.size(), 2u) << away;
    const double drawn = scene.snapshot.fingers[0].contact_W.x() - 1;
    EXPECT_GT(drawn, 0.04 * D) << away;
    EXPECT_LT(drawn, 0.4 * D) << away;
    EXPECT_NE(scene.marks.dimensions.at(0).text.find("drawn"), std::string::npos) << away;
    EXPECT_EQ(scene.snapshot.fingers[1].contact_W, Vector3d(-1, 0, 0));
  }
}

TEST(FaultScene, OtherFingersThatAreFarAwayAreLeftOut) {
  plan::Snapshot snapshot;
  for (const double x : {1.0, 1e6, 1e300}) {
    snapshot.fingers.push_back(MakeFinger(0, plan::FingerRole::kHolding, {x, 0, 0}, {-1, 0, 0}));
  }
  const FaultScene scene = MakeFaultScene(MakeCube(), 1, Reason::kTooManyFingers, {}, snapshot, "");
  EXPECT_EQ(scene.snapshot.fingers.size(), 1u);
}

TEST(FaultScene, TheGhostOfAnObjectThatMovedSlightlyIsVisiblyDisplaced) {
  const object::Polyhedron cube = MakeCube();
  plan::Snapshot snapshot;
  snapshot.X_WO.translation().z() = -1e-2;
  Fault fault;
  fault.X_WO_before = Eigen::Isometry3d::Identity();
  const FaultScene scene = MakeFaultScene(cube, 1, Reason::kObjectMoved, fault, snapshot, "");
  ASSERT_TRUE(scene.marks.X_WO_before.has_value());
  const double back = scene.marks.X_WO_before->translation().z() + 1e-2;
  EXPECT_NEAR(back, 0.05 * cube.diameter(), 1e-9);
  EXPECT_NE(scene.marks.ghost_text.find("drawn × "), std::string::npos);
}

TEST(FaultScene, AFallenObjectHasAGhostForEveryReason) {
  const object::Polyhedron cube = MakeCube();
  const auto has_ghost = [&](double fall) {
    plan::Snapshot snapshot;
    snapshot.X_WO.translation().z() = -fall;
    Fault fault;
    fault.X_WO_before = Eigen::Isometry3d::Identity();
    return MakeFaultScene(cube, 1, Reason::kContactLost, fault, snapshot, "")
        .marks.X_WO_before.has_value();
  };
  EXPECT_TRUE(has_ghost(0.3));
  EXPECT_FALSE(has_ghost(0.003));
}

TEST(FaultScene, AFactorIsTwoDigitsWithoutAPowerOfTen) {
  const auto text = [](double away) { return OffSurface(away).marks.dimensions.at(0).text; };
  EXPECT_EQ(text(0.1), "10 cm (drawn × 1.7)");
  EXPECT_EQ(text(0.001), "1 mm (drawn × 170)");
}

TEST(FaultScene, AFingerWithAWrongNormalIsDrawnOutside) {
  for (const Vector3d& given : {Vector3d(1, 0, 0), Vector3d(0, 0, 0), Vector3d(-3, 0, 0)}) {
    plan::Snapshot snapshot;
    snapshot.fingertip_radius_m = 0.1;
    snapshot.fingers = {MakeFinger(kFinger, plan::FingerRole::kHolding, {1, 0, 0}, given)};
    const Fault fault = {.fingers = {FingerIndex(kFinger)},
                         .found = grasp::Contact{{1, 0, 0}, given},
                         .expected = {{{1, 0, 0}, {-1, 0, 0}}}};
    const FaultScene scene =
        MakeFaultScene(MakeCube(), 1, Reason::kWrongNormal, fault, snapshot, "");
    ASSERT_EQ(scene.snapshot.fingers.size(), 1u) << given.transpose();
    EXPECT_EQ(scene.snapshot.fingers[0].normal_W, Vector3d(-1, 0, 0));
    EXPECT_NEAR(scene.snapshot.fingers[0].tip_W.x(), 1.1, 1e-12);
    EXPECT_TRUE(scene.marks.normals.back().expected) << "the true normal is drawn";
    EXPECT_EQ(scene.marks.normals.size(), given.x() > 0 ? 2u : 1u);
  }
}

TEST(FaultScene, TheFirstRequiredConeHasAText) {
  const grasp::Contact contact{{1, 0, 0}, {-1, 0, 0}}, opposite{{-1, 0, 0}, {1, 0, 0}};
  plan::Snapshot snapshot;
  snapshot.fingers = {MakeFinger(0, plan::FingerRole::kHolding, contact.p, contact.n),
                      MakeFinger(1, plan::FingerRole::kHolding, opposite.p, opposite.n)};
  const Fault fault = {.grasp = {{FingerIndex(0), contact}, {FingerIndex(1), opposite}},
                       .required = Radians(7.34)};
  const auto cones =
      MakeFaultScene(MakeCube(), 1, Reason::kNotForceClosure, fault, snapshot, "").marks.cones;
  ASSERT_EQ(cones.size(), 2u);
  EXPECT_EQ(cones[0].text, "requires 7.34°");
  EXPECT_EQ(cones[1].text, "");
}

/// Count the pixels of a small frame in the colour of faults.
int CountRed(const plan::Snapshot& snapshot, const FaultMarks* marks) {
  const object::Polyhedron cube = MakeCube();
  FrameRenderer renderer(cube, 1, Radians(20), {snapshot}, {320, 240, 1});
  const Image image = renderer.Render(snapshot, {}, marks);
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const unsigned char* p = &image.rgb[i];
    count += p[0] > 110 && p[1] < 0.22 * p[0] && p[2] < 0.35 * p[0];
  }
  return count;
}

TEST(FaultScene, MakesTheFrameRed) {
  const FaultScene scene = OffSurface(0.3);
  EXPECT_EQ(CountRed(scene.snapshot, nullptr), 0);
  EXPECT_GT(CountRed(scene.snapshot, &scene.marks), 100);
}

/// Return the marks of a hand's fault on a cube of 2 m, with the palm 3 m below it.
FaultMarks OfHand(const plan::HandFaultPlace& place, Reason reason) {
  plan::Snapshot snapshot;
  snapshot.X_WP = Eigen::Isometry3d(Eigen::Translation3d(0, 0, -3));
  snapshot.fingers = {MakeFinger(kFinger, plan::FingerRole::kHolding, {1, 0, 0}, {-1, 0, 0})};
  Fault fault;
  fault.fingers = {FingerIndex(kFinger)};
  fault.hand = place;
  if (place.pose) fault.X_WO_before = *snapshot.X_WP * *place.pose;
  return MakeFaultScene(MakeCube(), 1, reason, fault, snapshot, "the reason").marks;
}

TEST(FaultScene, FaultyLinksAreMarkedWithTheirNumber) {
  plan::HandFaultPlace place;
  place.links = {{FingerIndex(kFinger), 3}, {FingerIndex(), 0}};
  place.at = Vector3d(0.5, 0, 3);
  place.number = "1.5 mm inside";
  const FaultMarks marks = OfHand(place, Reason::kHandCollides);
  EXPECT_EQ(marks.links, place.links);
  ASSERT_EQ(marks.spots.size(), 1u);
  EXPECT_LT((marks.spots[0].at - Vector3d(0.5, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(marks.spots[0].text, "1.5 mm inside");
}

TEST(FaultScene, AFingertipOffItsContactHasASphereAndAVisibleLength) {
  plan::HandFaultPlace place;
  place.number = "1 mm";
  place.tip = {{1.301, 0, 3}, {1.3, 0, 3}, 0.3};
  const FaultMarks marks = OfHand(place, Reason::kTipOffContact);
  ASSERT_EQ(marks.fingertips.size(), 1u);
  EXPECT_LT((marks.fingertips[0].centre - Vector3d(1.3, 0, 0)).norm(), 1e-12);
  ASSERT_EQ(marks.dimensions.size(), 1u);
  EXPECT_GT((marks.dimensions[0].to - marks.dimensions[0].from).norm(),
            0.04 * MakeCube().diameter());
  EXPECT_EQ(marks.dimensions[0].text.find("1 mm (drawn"), 0u);
}

TEST(FaultScene, AnObjectAtAWrongPoseInTheHandHasAGhostAtTheExpectedPose) {
  plan::HandFaultPlace place;
  place.number = "1 mm";
  place.pose = Eigen::Isometry3d(Eigen::Translation3d(0.001, 0, 3));
  const FaultMarks jump = OfHand(place, Reason::kHandJumps);
  ASSERT_TRUE(jump.X_WO_before);
  EXPECT_EQ(jump.ghost_text.find("was here, 1 mm (motion drawn"), 0u) << jump.ghost_text;
  EXPECT_EQ(OfHand(place, Reason::kGoalNotReached).ghost_text.find("goal, 1 mm"), 0u);
}

TEST(FaultScene, AFaultyFingerWithoutPositionIsListedInTheFrame) {
  const plan::Snapshot snapshot = OffSurface(0.3).snapshot;
  const FaultMarks none{.heading = "", .fingers = {}};
  const FaultMarks absent{.heading = "", .fingers = {FingerIndex(7)}};
  EXPECT_EQ(CountRed(snapshot, &none), 0);
  EXPECT_GT(CountRed(snapshot, &absent), 30);
}

/// Count the pixels of numbers that clearly have another colour in `all`. The background is visible
/// only at the rims of thin lines.
int CountCovered(const Image& numbers, const Image& all) {
  constexpr int kClearly = 48;
  int covered = 0;
  for (std::size_t i = 0; i < numbers.rgb.size(); i += 3) {
    int change = 0;
    for (std::size_t k = i; k < i + 3; ++k) {
      change = std::max(change, std::abs(int{numbers.rgb[k]} - int{all.rgb[k]}));
    }
    const bool number = std::min(numbers.rgb[i], numbers.rgb[i + 1]) < 128;
    covered += number && change > kClearly;
  }
  return covered;
}

TEST(FaultScene, NumbersStandOverTheMarks) {
  // If numbers were placed first, the arc of a torque would cross one of them.
  const object::Polyhedron cube = MakeCube();
  const BodyShape body = MakeBodyShape(cube);
  const NormalizedFrame frame = {cube.diameter(), Vector3d::Zero()};
  plan::Snapshot snapshot;
  for (int i = 0; i < 12; ++i) {
    const Vector3d along(std::cos(Radians(30.0 * i)), 0, std::sin(Radians(30.0 * i)));
    snapshot.fingers.push_back(
        MakeFinger(i, plan::FingerRole::kHolding, 0.01 * cube.diameter() * along, -along));
  }
  const std::vector<FingerGlyph> fingers = MakeFingerGlyphs(snapshot, frame, RayTree());
  Camera camera;
  camera.axes = CameraAxes(-Vector3d::UnitY());
  camera.position = 10 * camera.axes.col(2);
  camera.projection = Projection::kOrthographic;
  camera.half_height = 0.25;
  camera.width = camera.height = 480;
  const TextStyle style = {16, {}};
  FaultMarks twist{.heading = "", .fingers = {}};
  twist.disturbance = plan::FaultDisturbance{.name = "a twist"};
  twist.disturbance->torque_Nm = Vector3d::UnitY();
  const auto covered = [&](bool numbers_first) {
    const CairoImage alone(MakeImage(480, 480)), all(MakeImage(480, 480));
    const auto draw_marks = [&] {
      return DrawFaultMarks(all, camera, frame, body, fingers, twist, style);
    };
    const std::vector<Obstacle> marks = numbers_first ? std::vector<Obstacle>() : draw_marks();
    for (const CairoImage* page : {&alone, &all}) {
      DrawNumbers(*page, camera, fingers, {}, marks, style);
    }
    if (numbers_first) std::ignore = draw_marks();
    return CountCovered(alone.ToImage(), all.ToImage());
  };
  EXPECT_GT(covered(/*numbers_first=*/true), 50);
  EXPECT_EQ(covered(/*numbers_first=*/false), 0);
}

}  // namespace fault_marks_test
}  // namespace regrasp::render
