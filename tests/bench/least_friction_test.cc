#include "bench/least_friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/grasp/required_friction_angle.h"

namespace regrasp::bench {
namespace least_friction_test {

using Eigen::Vector3d;

const object::WrenchFrame kFrame;
const grasp::Wrench kWeight = {-Vector3d::UnitZ(), Vector3d::Zero()};
constexpr double kMostNormal = 40;  // multiples of the weight
/// Relative reduction of the result by the part that may stay unbalanced.
constexpr double kLess = 0.06;
constexpr double kMore = 2e-3;

/// Return a contact on the unit sphere. @param towards  direction of the inward normal.
grasp::Contact At(const Vector3d& p, const Vector3d& towards) {
  return {p, towards.normalized(), {}, 0};
}

Vector3d Draw(RandomStream& random) { return {random.Normal(), random.Normal(), random.Normal()}; }

TEST(LeastFrictionTest, OnASlopeItIsTheTangentOfTheAngle) {
  for (const double degrees : {15.0, 30.0, 45.0}) {
    const double angle = Radians(degrees);
    const std::vector<grasp::Contact> below = {
        At(-Vector3d::UnitZ(), {std::sin(angle), 0, std::cos(angle)})};
    const double least = LeastFriction(below, kFrame, {{kWeight}}, kMostNormal);
    // A share of the weight, which is 1, may stay unbalanced across the slope.
    EXPECT_LE(least, (1 + kMore) * std::tan(angle));
    EXPECT_GT(least, std::tan(angle) - kLess / std::cos(angle));
  }
}

TEST(LeastFrictionTest, BetweenTwoFingersItIsTheWeightOverAllTheyPushAndATwistAboutThemIsNotHeld) {
  const std::vector<grasp::Contact> pair = {At(-Vector3d::UnitX(), Vector3d::UnitX()),
                                            At(Vector3d::UnitX(), -Vector3d::UnitX())};
  for (const double most : {kMostNormal, 2 * kMostNormal}) {
    const double least = LeastFriction(pair, kFrame, {{kWeight}}, most);
    EXPECT_LE(least, (1 + kMore) / most);
    EXPECT_GT(least, (1 - kLess) / most);
  }
  const grasp::Wrench twist = {Vector3d::Zero(), Vector3d::UnitX()};
  EXPECT_TRUE(std::isinf(LeastFriction(pair, kFrame, {{kWeight, twist}}, kMostNormal)));
}

/// Forces and torques in both directions of all axes span all wrenches. With sufficient normal
/// forces, they require the friction of force closure.
TEST(LeastFrictionTest, ForAllDirectionsItIsThatOfForceClosureAndForTheWeightNoMore) {
  constexpr double kHard = 1e6;
  constexpr int kCompared = 8;
  RandomStream random(1, RandomUse::kContactPoints);
  int compared = 0;
  int easier = 0;
  while (compared < kCompared) {
    std::vector<grasp::Contact> contacts;
    for (int k = 0; k < 4; ++k) {
      const Vector3d p = Draw(random).normalized();
      contacts.push_back(At(p, -p + 0.2 * Draw(random)));
    }
    const auto closure = grasp::ComputeRequiredFrictionAngle(contacts, kFrame);
    if (!closure || std::tan(closure->upper) > 2) continue;
    ++compared;
    const double critical = std::tan(closure->upper);
    std::vector<grasp::Wrench> all;
    for (int axis = 0; axis < 3; ++axis) {
      for (const Vector3d& one :
           {Vector3d(Vector3d::Unit(axis)), Vector3d(-Vector3d::Unit(axis))}) {
        all.push_back({one, Vector3d::Zero()});
        all.push_back({Vector3d::Zero(), one});
      }
    }
    const double least = LeastFriction(contacts, kFrame, all, kHard);
    EXPECT_LE(least, (1 + kMore) * critical);
    EXPECT_GT(least, (1 - kLess) * critical);
    const double weight = LeastFriction(contacts, kFrame, {{kWeight}}, kHard);
    EXPECT_LE(weight, (1 + kMore) * critical);
    easier += static_cast<int>(weight < (1 - kLess) * critical);
  }
  EXPECT_GT(easier, 0);
}

}  // namespace least_friction_test
}  // namespace regrasp::bench
