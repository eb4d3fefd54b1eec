#include "sim/measure/weakest_finger.h"

#include <gtest/gtest.h>

#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace weakest_finger_test {

using plan::EntryIndex;

/// Compute the expected result of WeakestFingers for a step from its grasps one by one.
std::optional<NeedOfFinger> WeakestOf(const std::vector<plan::FingerGrasp>& grasps,
                                      const object::WrenchFrame& frame, double friction_angle) {
  std::vector<NeedOfFinger> needs;
  std::vector<grasp::FingerFriction> friction;
  for (const plan::FingerGrasp& grasp : grasps) {
    const auto all = grasp::MeasureFingerFriction(plan::ContactsOf(grasp), frame, friction_angle);
    for (std::size_t i = 0; i < all.size(); ++i) needs.push_back({grasp[i].finger, all[i]});
    friction.insert(friction.end(), all.begin(), all.end());
  }
  const int weakest = grasp::WeakestFinger(friction);
  return weakest < 0 ? std::nullopt : std::optional(needs[weakest]);
}

TEST(WeakestFingerTest, OfEveryEntryItIsTheWeakestOfAllItsGrasps) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  const plan::Switch change{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}};
  const plan::FingerGrasp after = plan::GraspAfter(plan.initial, change);
  plan::FingerGrasp moved = after;
  moved.back().contact.p.x() += 0.01;
  plan.steps = {change, plan::Align{{after, moved}}};
  const object::WrenchFrame frame = cube.object.wrench_frame();
  WeakestFingers fingers(plan, frame, Radians(25));
  const std::vector<std::vector<plan::FingerGrasp>> expected = {
      {plan.initial}, {plan.initial, after}, {after, moved}};
  int different = 0;
  for (int entry = 0; entry < 3; ++entry) {
    const auto found = fingers.OfEntry(EntryIndex(entry));
    const auto weakest = WeakestOf(expected[entry], frame, Radians(25));
    ASSERT_TRUE(found && weakest) << entry;
    EXPECT_EQ(found->finger, weakest->finger) << entry;
    EXPECT_EQ(found->friction.required, weakest->friction.required) << entry;
    EXPECT_EQ(found->friction.without, weakest->friction.without) << entry;
    const auto initial = fingers.OfEntry(EntryIndex(0));
    different += initial->friction.required != found->friction.required ? 1 : 0;
  }
  EXPECT_GT(different, 0);
}

TEST(WeakestFingerTest, AGraspThatIsNotForceClosureHasNone) {
  const CubeCase cube;
  const object::WrenchFrame frame = cube.object.wrench_frame();
  const plan::Plan weak = MakePlan(cube.Start(), 4);
  EXPECT_FALSE(WeakestFingers(weak, frame, Radians(4)).OfEntry(EntryIndex(0)));
  const plan::Plan empty = MakePlan({}, 4);
  EXPECT_FALSE(WeakestFingers(empty, frame, Radians(4)).OfEntry(EntryIndex(0)));
}

}  // namespace weakest_finger_test
}  // namespace regrasp::sim
