#include "sim/actuation/penetration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/actuation/execution_monitor.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/edited_hand.h"

namespace regrasp::sim {
namespace penetration_test {

using collision::ConvexShape;
using Eigen::Vector3d;
using plan::Reason;
using testing::HasSubstr;

class PenetrationTest : public EditedHandTest {
 protected:
  static constexpr double kHalf = 0.03 * kScale;  ///< half of the cube's edge, m

  /// Return the hand with a different sphere at the fingertip of finger 0 in the model. The hand
  /// file keeps its sphere.
  [[nodiscard]] kinematics::HandFile HandWithSphere(const std::string& radius) const {
    return HandWith({{"name=\"finger0_tip\" type=\"sphere\" size=\"0.01\"",
                      "name=\"finger0_tip\" type=\"sphere\" size=\"" + radius + "\""}});
  }
  /// Return true if finger 0 is a holding finger.
  [[nodiscard]] static bool IsHeldByFirst(const plan::Plan& plan) {
    return plan::FindFinger(plan.initial, FingerIndex(0)) != nullptr;
  }
};

TEST_F(PenetrationTest, ShapesAreAsDeepAsTheyAre) {
  const Penetration cube(solid(), kScale);
  constexpr double kRadius = 0.01;
  constexpr double kMost = 0.02;
  for (const double depth : {2e-4, 1e-3, 5e-3, 1.2e-2}) {
    const ConvexShape ball{{Vector3d(kHalf + kRadius - depth, 0.001, 0.002)}, kRadius};
    const ConvexShape box{{Vector3d(kHalf - depth, -0.004, -0.004), Vector3d(0.1, -0.004, -0.004),
                           Vector3d(kHalf - depth, 0.004, 0.004), Vector3d(0.1, 0.004, 0.004)},
                          0};
    for (const ConvexShape& shape : {ball, box}) {
      for (const Vector3d& outward : {Vector3d(1, 0, 0), Vector3d(0, 0, 0)}) {
        EXPECT_TRUE(cube.IsDeeper(shape, 0.99 * depth, outward));
        EXPECT_FALSE(cube.IsDeeper(shape, 1.01 * depth, outward));
        EXPECT_NEAR(cube.Depth(shape, kMost, outward), depth, 6e-5);
      }
    }
  }
  // Completely inside, far from the surface.
  const ConvexShape inside{{Vector3d(0.001, 0, 0)}, 0.002};
  EXPECT_TRUE(cube.IsDeeper(inside, 0.02, Vector3d::Zero()));
  EXPECT_TRUE(cube.Contains(Vector3d(kHalf - 1e-6, 0, 0)));
  EXPECT_FALSE(cube.Contains(Vector3d(kHalf + 1e-6, 0, 0)));
  const ConvexShape apart{{Vector3d(kHalf + 1.01 * kRadius, 0, 0)}, kRadius};
  EXPECT_FALSE(cube.IsDeeper(apart, 0, Vector3d::Zero()));
  EXPECT_EQ(cube.Depth(apart, kMost, Vector3d::Zero()), 0);
}

TEST_F(PenetrationTest, AFingertipThatIsTooDeepInTheObjectIsNamed) {
  const kinematics::HandFile hand = HandWith({});
  const plan::Plan plan = PlanFor(hand);
  HandWorld world(hand, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  const plan::FingerContact& held = plan.initial.front();
  for (const double depth : {9e-4, 1.1e-3, 5.3e-3}) {
    plan::HandState state = plan.hand->initial;
    // Move the object against the finger, whose normal points into the object.
    state.pose.translation() -= depth * (state.pose.linear() * held.contact.n);
    world.Place(state);
    ExecutionMonitor monitor(world, solid(), kScale, {});
    monitor.Start();
    monitor.Watch(state.pose);
    ASSERT_EQ(monitor.violation().has_value(), depth > 1e-3) << monitor.violation()->detail;
    if (!monitor.violation()) continue;
    EXPECT_EQ(monitor.violation()->reason, Reason::kTipPenetrates);
    EXPECT_THAT(monitor.violation()->detail, HasSubstr("the fingertip sphere of finger"));
    EXPECT_THAT(monitor.violation()->detail, HasSubstr("inside the object, limit 1 mm"));
    EXPECT_THAT(monitor.violation()->fault.fingers, testing::ElementsAre(held.finger));
  }
}

TEST_F(PenetrationTest, GeometryOfAFingertipIsCheckedAgainstTheObject) {
  const plan::Plan plan = PlanFor(HandWith({}));
  ASSERT_TRUE(IsHeldByFirst(plan));
  HandReplayOptions options;
  options.mass_kg = kMass;
  const auto replay = [&](const std::string& radius) {
    return ReplayHand(HandWithSphere(radius), solid(), plan, options);
  };
  const ReplayResult plain = replay("0.01");
  EXPECT_EQ(plain.steps.back().reason, Reason::kNone) << plain.steps.back().detail;
  EXPECT_LT(plain.steps.back().hand->covered_depth_m, 5e-4);
  const ReplayResult fat = replay("0.013");
  EXPECT_EQ(fat.steps.back().reason, Reason::kNone) << fat.steps.back().detail;
  EXPECT_NEAR(fat.steps.front().hand->covered_depth_m, 3e-3, 3e-4);
  const ReplayResult too_fat = replay("0.0165");
  EXPECT_EQ(too_fat.steps.back().reason, Reason::kTipPenetrates);
  EXPECT_THAT(too_fat.steps.back().detail,
              HasSubstr("the collision geometry of body finger0_distal of finger 0"));
}

TEST_F(PenetrationTest, GeometryOfAFingertipIsCheckedAgainstOtherLinks) {
  const kinematics::HandFile plain = HandWith({});
  // Rod to the side, which touches the next finger if this finger bends.
  const kinematics::HandFile with_rod =
      HandWith({{"<geom name=\"finger0_tip\"",
                 "<geom type=\"capsule\" size=\"0.004\" fromto=\"0 0 0.012 0 0.055 0.012\"/>"
                 "<geom name=\"finger0_tip\""}});
  const auto collisions = [&](const kinematics::HandFile& hand) {
    HandWorld world(hand, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
    std::vector<std::string> details;
    for (double angle = 0; angle < 1.2; angle += 0.1) {
      plan::HandState state;
      state.pose = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1));  // out of reach
      state.joints.assign(5, std::vector<double>(4, 0));
      state.joints[0][1] = angle;
      world.Place(state);
      ExecutionMonitor monitor(world, solid(), kScale, {});
      monitor.Start();
      monitor.Watch(state.pose);
      if (!monitor.violation()) continue;
      EXPECT_EQ(monitor.violation()->reason, Reason::kHandCollides);
      details.push_back(monitor.violation()->detail);
    }
    return details;
  };
  EXPECT_THAT(collisions(plain), testing::IsEmpty());
  const std::vector<std::string> found = collisions(with_rod);
  EXPECT_THAT(found, testing::Not(testing::IsEmpty()));
  EXPECT_THAT(found, testing::Each(HasSubstr("finger0_distal of finger 0 (finger0) touches")));
}

}  // namespace penetration_test
}  // namespace regrasp::sim
