#include "sim/measure/weakest_finger.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace {

TEST(WeakestFingerTest, ASwitchCountsTheGraspsBeforeAndAfterItByTheFingersOfTheHand) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  plan.steps = {plan::Switch{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}},
                plan::Align{{cube.Start(), cube.Start()}}};
  const object::WrenchFrame frame = cube.object.wrench_frame();
  const auto fingers = [&](int entry) {
    std::multiset<int> all;
    for (const NeedOfFinger& need :
         NeedsOfEntry(plan, plan::EntryIndex(entry), frame, Radians(25))) {
      all.insert(need.finger);
    }
    return all;
  };
  EXPECT_EQ(fingers(0), (std::multiset<int>{0, 1, 2, 3}));
  EXPECT_EQ(fingers(1), (std::multiset<int>{0, 0, 1, 1, 2, 3, 3, 4}));
  EXPECT_EQ(fingers(2), (std::multiset<int>{0, 0, 1, 1, 2, 2, 3, 3}));
}

TEST(WeakestFingerTest, TheWeakestHasTheLeastOfItsOwnFrictionToSpare) {
  std::vector<NeedOfFinger> needs;
  EXPECT_EQ(WeakestOf(needs), -1);
  needs = {{FingerIndex(4), {0.1, true, std::nullopt}},
           {FingerIndex(7), {0.3, true, std::nullopt}},
           {FingerIndex(1), {0, false, 0.2}}};
  EXPECT_EQ(WeakestOf(needs), 1);
}

TEST(WeakestFingerTest, AGraspThatIsNotForceClosureHasNone) {
  const CubeCase cube;
  EXPECT_TRUE(NeedsOfEntry(MakePlan(cube.Start(), 4), plan::EntryIndex(0),
                           cube.object.wrench_frame(), Radians(4))
                  .empty());
  EXPECT_TRUE(
      NeedsOfEntry(MakePlan({}, 4), plan::EntryIndex(0), cube.object.wrench_frame(), Radians(4))
          .empty());
}

}  // namespace
}  // namespace regrasp::sim
