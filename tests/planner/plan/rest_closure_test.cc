#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/plan/check_step.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::plan {
namespace rest_closure_test {

FingerGrasp Held(const grasp::Grasp& grasp) {
  FingerGrasp held;
  for (const grasp::Contact& contact : grasp) {
    held.push_back({FingerIndex(static_cast<int>(held.size())), contact});
  }
  return held;
}

TEST(RestClosureTest, SaysOfEveryGraspWhatIsFoundOfItAlone) {
  RandomGrasps random(8);
  const double friction_angle = Radians(30);
  const object::WrenchFrame frame = UnitFrame(3);
  StaticGraspClosure rests(frame, friction_angle);
  int holds = 0, fails = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const grasp::Grasp grasp = random.OnBall(4, 3);
    const auto required = grasp::ComputeRequiredFrictionAngle(grasp, frame);
    const bool expected = grasp::IsForceClosure(grasp, frame, friction_angle);
    for (int again = 0; again < 2; ++again) {
      const StaticGraspClosure::Found& found = rests.Of(Held(grasp));
      EXPECT_EQ(found.holds, expected);
      ASSERT_EQ(found.required.has_value(), required.has_value());
      if (!required) continue;
      const double upper = expected ? std::min(required->upper, friction_angle) : required->upper;
      EXPECT_EQ(found.required->upper, upper);
    }
    ++(expected ? holds : fails);
  }
  EXPECT_GT(holds, 10);
  EXPECT_GT(fails, 10);
}

TEST(RestClosureTest, OneWithoutContactsDoesNotHold) {
  RandomGrasps random(9);
  StaticGraspClosure rests(UnitFrame(3), Radians(60));
  EXPECT_FALSE(rests.Of({}).holds);
  EXPECT_FALSE(rests.Of({}).required);
  EXPECT_TRUE(rests.Of(Held(random.OnBall(5, 3, 0))).required);
  EXPECT_FALSE(rests.Of({}).holds);
}

}  // namespace rest_closure_test
}  // namespace regrasp::plan
