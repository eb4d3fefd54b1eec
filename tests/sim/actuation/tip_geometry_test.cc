#include "sim/actuation/tip_geometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/kinematics/mujoco_model.h"
#include "planner/plan/projection.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::sim {
namespace tip_geometry_test {

using Eigen::Vector3d;
using plan::Reason;

constexpr double kScale = 0.8333;  // edge length of 5 cm
constexpr double kMu = 0.8;
/// distance of a fingertip sphere that is not near the surface, or a lower bound of it
constexpr double kFar = 0.015;

const object::Polyhedron& Cube() {
  static const object::ObjectFile file = object::ReadObject(ProjectPath("models/cube.obj"));
  return dynamic_cast<const object::Polyhedron&>(*file.object);
}

/// Return ring5 with other geoms at the fingertips. The fingertips in its file are spheres.
/// @param tip      attributes that replace the sphere.
/// @param capsule  attributes that replace the capsule.
kinematics::HandFile HandWithTips(const std::string& tip, const std::string& capsule) {
  std::string model = ReadFile(ProjectPath("models/hands/ring5.xml"));
  const auto replace = [&](const std::string& from, const std::string& to) {
    int replaced = 0;
    for (std::size_t at = 0; (at = model.find(from, at)) != std::string::npos; ++replaced) {
      model.replace(at, from.size(), to);
      at += to.size();
    }
    EXPECT_EQ(replaced, 5) << from;
  };
  replace(R"(type="sphere" size="0.01" pos="0 0 0.024")", tip);
  replace(R"(type="capsule" size="0.008" fromto="0 0 0 0 0 0.024")", capsule);
  const std::string path = testing::TempDir() + "tip_geometry_" + std::to_string(getpid()) + ".xml";
  WriteFile(path, model);
  // Replace only the compiled model, because the hand reader requires spheres at the fingertips.
  kinematics::HandFile file = kinematics::ReadHandFile(ProjectPath("models/hands/ring5.json"));
  file.compiled = std::make_shared<const kinematics::CompiledModel>(kinematics::CompileModel(path));
  return file;
}

/// Return the hand with the shapes of its compiled model.
kinematics::HandFile WithItsShapes(kinematics::HandFile file) {
  const kinematics::HandModel hand =
      kinematics::BuildHand(file.description, *file.compiled, "ring5.json");
  file.hand.fingers = hand.fingers;
  file.hand.ignored = hand.ignored;
  return file;
}

constexpr char kBall[] = R"(type="sphere" size="0.01" pos="0 0 0.024")";
constexpr char kThinCapsule[] = R"(type="capsule" size="0.004" fromto="0 0 0 0 0 0.012")";

const kinematics::HandFile& Ring() {
  static const kinematics::HandFile file =
      kinematics::ReadHandFile(ProjectPath("models/hands/ring5.json"));
  return file;
}

/// Return a rotation of 30°, which passes.
const plan::Plan& Turn() {
  static const plan::Plan plan = [] {
    gait::GaitRequest request;
    request.hand = &Ring().hand;
    request.solid = &Cube();
    request.scale = kScale;
    request.criteria.friction_angle = std::atan(kMu);
    request.criteria.min_quality = 0.06;
    request.turn = {Vector3d::UnitZ(), 0.5};
    const gait::GaitResult found = gait::FindGait(request);
    EXPECT_TRUE(found.gait) << found.message;
    return plan::ProjectPlan(Cube(), gait::PlanOf(*found.gait, request, found.contacts));
  }();
  return plan;
}

struct Replayed {
  ReplayResult result;
  /// Distances of the sphere centres of holding fingers from the surface, in the first static grasp
  /// or just before the failure.
  std::vector<double> heights;

  [[nodiscard]] Reason reason() const { return result.steps.back().reason; }
  [[nodiscard]] const std::string& detail() const { return result.steps.back().detail; }
};

Replayed ReplayWith(const kinematics::HandFile& hand, TipShape tip) {
  Replayed replayed;
  HandReplayOptions options;
  options.mass_kg = 0.125;
  options.tip = tip;
  ReplayObserver observer;
  bool rests = false;
  observer.on_rest = [&](const HandWorld& /*world*/, plan::EntryIndex /*entry*/) { rests = true; };
  observer.on_time_step = [&](const HandWorld& world) {
    if (rests) return;
    replayed.heights.clear();
    for (const plan::FingerContact& held : Turn().initial) {
      const auto near = world.NearBall(held.finger);
      replayed.heights.push_back(near ? near->distance : kFar);
    }
  };
  replayed.result = ReplayHand(hand, Cube(), Turn(), options, observer);
  return replayed;
}

TEST(TipGeometryTest, TheTipsOfAHandAreWhatItsFileOrItsModelSays) {
  for (const TipShapes& ball : TipShapesOf(Ring(), TipShape::kBall)) {
    ASSERT_EQ(ball.size(), 1U);
    EXPECT_EQ(ball[0].points, std::vector<Vector3d>{Vector3d(0, 0, 0.024)});
    EXPECT_EQ(ball[0].radius, 0.01);
  }
  for (const TipShapes& geometry : TipShapesOf(Ring(), TipShape::kGeometry)) {
    ASSERT_EQ(geometry.size(), 2U);
    EXPECT_EQ(geometry[0].points.size(), 2U);
    EXPECT_NEAR(geometry[0].radius, 0.008, 1e-12);
    EXPECT_NEAR((geometry[1].points.at(0) - Vector3d(0, 0, 0.024)).norm(), 0, 1e-12);
    EXPECT_NEAR(geometry[1].radius, 0.01, 1e-12);
  }
  const kinematics::HandFile boxes =
      HandWithTips(R"(type="box" size="0.01 0.006 0.003" pos="0 0 0.02")", kThinCapsule);
  for (const TipShapes& geometry : TipShapesOf(boxes, TipShape::kGeometry)) {
    EXPECT_EQ(geometry[1].points.size(), 8U);
    EXPECT_EQ(geometry[1].radius, kTipSkin);
    for (const Vector3d& point : geometry[1].points) {
      EXPECT_NEAR(std::abs(point.z() - 0.02), 0.003, 1e-12);
    }
  }
}

TEST(TipGeometryTest, ATipWithoutCollisionGeometryIsNamed) {
  const std::string none = R"( contype="0" conaffinity="0")";
  const kinematics::HandFile bare = HandWithTips(kBall + none, kThinCapsule + none);
  EXPECT_EQ(TipShapesOf(bare, TipShape::kBall).size(), 5U);
  try {
    static_cast<void>(TipShapesOf(bare, TipShape::kGeometry));
    FAIL() << "is not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("ring5.xml: fingertip link finger0_distal of "
                                                  "finger 0 (finger0) has no collision geometry"),
                               testing::Not(testing::HasSubstr("\n"))));
  }
  EXPECT_EQ(ReplayWith(bare, TipShape::kBall).reason(), Reason::kNone);
}

TEST(TipGeometryTest, WhereTheModelHasTheBallBothReplaysAreTheSame) {
  const Replayed ball = ReplayWith(Ring(), TipShape::kBall);
  const Replayed own = ReplayWith(Ring(), TipShape::kGeometry);
  EXPECT_EQ(ball.reason(), Reason::kNone) << ball.detail();
  ASSERT_EQ(own.result.steps.size(), ball.result.steps.size());
  EXPECT_EQ(own.result.settings.hand->tip, TipShape::kGeometry);
  for (std::size_t i = 0; i < own.result.steps.size(); ++i) {
    const StepReplay& a = ball.result.steps[i];
    const StepReplay& b = own.result.steps[i];
    EXPECT_EQ(b.reason, a.reason) << b.detail;
    EXPECT_NEAR(b.hand->off_m, a.hand->off_m, 1e-6);
    EXPECT_NEAR(b.hand->slip_m, a.hand->slip_m, 1e-6);
    EXPECT_NEAR(b.hand->roll_m, a.hand->roll_m, 1e-5);
    EXPECT_NEAR(b.hand->torque_share, a.hand->torque_share, 1e-3);
  }
}

TEST(TipGeometryTest, ASmallerTipIsPressedUntilItTouches) {
  const kinematics::HandFile small =
      WithItsShapes(HandWithTips(R"(type="sphere" size="0.0085" pos="0 0 0.024")", kThinCapsule));
  const Replayed ball = ReplayWith(small, TipShape::kBall);
  const Replayed own = ReplayWith(small, TipShape::kGeometry);
  EXPECT_EQ(own.reason(), Reason::kNone) << own.detail();
  ASSERT_FALSE(own.heights.empty());
  for (const double height : ball.heights) EXPECT_NEAR(height, 0.01, 1e-4);
  for (const double height : own.heights) EXPECT_NEAR(height, 0.0085, 1e-4);
}

TEST(TipGeometryTest, ABoxStandsOnItsCornersAndEdges) {
  // The box contains the sphere, and extends beyond it by 4 mm at its edges and 7 mm at its
  // corners.
  const kinematics::HandFile boxes = WithItsShapes(
      HandWithTips(R"(type="box" size="0.01 0.01 0.01" pos="0 0 0.024")", kThinCapsule));
  const Replayed ball = ReplayWith(boxes, TipShape::kBall);
  const Replayed own = ReplayWith(boxes, TipShape::kGeometry);
  EXPECT_EQ(ball.reason(), Reason::kTipPenetrates);
  EXPECT_THAT(ball.detail(), testing::HasSubstr("the collision geometry of body finger"));
  // The box contains the sphere, so the sphere's centre is never nearer than the radius. A box does
  // not lie flat at all fingers.
  ASSERT_FALSE(own.heights.empty()) << own.detail();
  EXPECT_GT(*std::ranges::min_element(own.heights), 0.0099);
  EXPECT_GT(*std::ranges::max_element(own.heights), 0.011);
}

TEST(TipGeometryTest, AHandWhoseTipsEndShortOfTheirBallsDoesNotHold) {
  const kinematics::HandFile stumps =
      HandWithTips(R"(type="sphere" size="0.004" pos="0 0 0.004")", kThinCapsule);
  EXPECT_EQ(ReplayWith(stumps, TipShape::kBall).reason(), Reason::kNone);
  EXPECT_NE(ReplayWith(stumps, TipShape::kGeometry).reason(), Reason::kNone);
}

}  // namespace tip_geometry_test
}  // namespace regrasp::sim
