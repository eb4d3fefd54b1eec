#include "planner/gait/random_stances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/kinematics/finger_kinematics.h"
#include "tests/planner/gait/gait_requests.h"

namespace regrasp::gait {
namespace random_stances_test {

constexpr double kScale = 0.8333;
constexpr int kTries = 20'000;

/// Convert joint angles; every joint of this hand is independent.
kinematics::JointConfiguration ConfigurationOf(const std::vector<double>& joints) {
  return Eigen::Map<const Eigen::VectorXd>(joints.data(), std::ssize(joints));
}

TEST(RandomStancesTest, FingertipsTouchTheContactsOfAnAdmissibleGraspAndNothingElse) {
  const GaitRequest request = RequestFor("cube", kScale, 0);
  const RandomStances stances(request, {.fewest = 3, .most = 4});
  const collision::SurfaceTree surface(*request.solid, request.scale);
  const HandScene scene(*request.hand, surface, request.margin);
  const criteria::GraspEvaluator evaluator(*request.solid, request.criteria);
  RandomStream random(1, RandomUse::kResetStates);
  std::map<std::size_t, int> by_fingers;
  for (int i = 0; i < 40; ++i) {
    const auto stance = stances.Draw(random, kTries);
    ASSERT_TRUE(stance);
    ++by_fingers[stance->grasp.size()];
    EXPECT_TRUE(evaluator.IsAdmitted(plan::ContactsOf(stance->grasp)));
    EXPECT_TRUE(scene.KeepsOffPalm(stance->state.pose));
    std::vector<PlacedFinger> placed;
    for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
      placed.push_back(scene.Place(finger, ConfigurationOf(stance->state.joints[finger])));
      const plan::FingerContact* holding = plan::FindFinger(stance->grasp, finger);
      EXPECT_TRUE(scene.KeepsOffHand(placed.back()));
      EXPECT_TRUE(scene.KeepsOffObject(placed.back(), stance->state.pose,
                                       holding ? TipContact::kTouching : TipContact::kFree));
      for (FingerIndex other{0}; other < finger; ++other) {
        EXPECT_TRUE(scene.KeepApart(placed[other], placed[finger]));
      }
      if (!holding) continue;
      const kinematics::Finger& chain = scene.finger(finger);
      const auto tip = kinematics::TipAt(chain, ConfigurationOf(stance->state.joints[finger]));
      const Eigen::Vector3d centre = stance->state.pose.inverse() * tip.centre;
      const Eigen::Vector3d contact = centre + chain.tip.radius * holding->contact.n;
      EXPECT_LT((contact - kScale * holding->contact.p).norm(), 1e-8);
    }
  }
  EXPECT_GT(by_fingers[3], 0);
  EXPECT_GT(by_fingers[4], 0);
}

TEST(RandomStancesTest, ADrawDependsOnItsRandomStreamOnly) {
  const GaitRequest request = RequestFor("cube", kScale, 0);
  const RandomStances stances(request, {});
  const auto draw = [&](std::uint64_t index) {
    RandomStream random(1, RandomUse::kResetStates, index);
    return *stances.Draw(random, kTries);
  };
  const RandomStance first = draw(0);
  const RandomStance second = draw(1);
  EXPECT_NE(first.state.joints, second.state.joints);
  EXPECT_EQ(draw(0).state.joints, first.state.joints);
}

TEST(RandomStancesTest, AStartPoseIsKept) {
  GaitRequest request = RequestFor("cube", kScale, 0);
  RandomStream random(1, RandomUse::kResetStates);
  request.start_pose = RandomStances(request, {}).Draw(random, kTries)->state.pose;
  const RandomStances stances(request, {});
  for (int i = 0; i < 3; ++i) {
    const auto stance = stances.Draw(random, kTries);
    ASSERT_TRUE(stance);
    EXPECT_TRUE(stance->state.pose.isApprox(*request.start_pose, 0));
  }
}

TEST(RandomStancesTest, ContactsAreAmongTheCandidates) {
  const GaitRequest request = RequestFor("cube", kScale, 0);
  RandomStanceOptions options;
  const sampling::SurfaceSampler sampler(*request.solid);
  RandomStream random(1, RandomUse::kResetStates);
  for (int i = 0; i < 100; ++i) options.among.push_back(sampler.Draw(random));
  const RandomStances stances(request, options);
  for (int i = 0; i < 5; ++i) {
    const auto stance = stances.Draw(random, kTries);
    ASSERT_TRUE(stance);
    for (const plan::FingerContact& holding : stance->grasp) {
      EXPECT_EQ(std::ranges::count(options.among, holding.contact.p, &grasp::Contact::p), 1);
    }
  }
}

TEST(RandomStancesTest, TooLargeOrTooSlipperyObjectsHaveNoStance) {
  RandomStream random(1, RandomUse::kResetStates);
  const GaitRequest large = RequestFor("cube", 10, 0);
  EXPECT_FALSE(RandomStances(large, {}).Draw(random, 2000));
  GaitRequest slippery = RequestFor("cube", kScale, 0);
  slippery.criteria.friction_angle = 0.01;
  EXPECT_FALSE(RandomStances(slippery, {}).Draw(random, 2000));
}

TEST(RandomStancesTest, TheNumberOfHoldingFingersIsChecked) {
  const GaitRequest request = RequestFor("cube", kScale, 0);
  for (const auto& [fewest, most] : {std::pair(2, 3), {4, 3}, {3, 5}}) {
    const RandomStanceOptions options{.fewest = fewest, .most = most};
    EXPECT_THROW(RandomStances(request, options), std::invalid_argument);
  }
}

}  // namespace random_stances_test
}  // namespace regrasp::gait
