#include "planner/sets/set_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "planner/sampling/surface_sampler.h"
#include "tests/fixtures/edge_grasp.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::sets {
namespace set_sampling_test {

std::vector<SetIndex> Sets(const std::vector<int>& numbers) {
  return {numbers.begin(), numbers.end()};
}

class DrawFromSetsOfASquare : public testing::Test {
 protected:
  /// Draw from sets of which only set 3 has a good grasp. The others have none, or one without
  /// force closure.
  grasp::Grasp Draw(SamplingPools pools) {
    return DrawFromSets(
        "goal", std::move(pools),
        [&](SetIndex set) {
          seen_.push_back(set);
          if (set == SetIndex(3)) return MakeGrasp(square_, {{0, 0.5}, {2, 0.5}});
          if (set == SetIndex(2)) return MakeGrasp(square_, {{0, 0.5}, {1, 0.5}});
          return grasp::Grasp();
        },
        evaluator_, random_);
  }

  const object::Polygon square_ = Square(1);
  const criteria::GraspEvaluator evaluator_{square_, {.friction_angle = Radians(20)}};
  RandomStream random_{1, RandomUse::kGoal};
  std::vector<SetIndex> seen_;
};

TEST(SamplingPools, AStartMayBeInEverySet) {
  EXPECT_EQ(StartPools(3), SamplingPools{Sets({0, 1, 2})});
}

TEST(SamplingPools, AGoalIsInTheStartsComponentsAndInItsOwnSetsLast) {
  const search::Components components{{0, 1, 0, 1, 2, 0}, {3, 2, 1}};
  EXPECT_EQ(GoalPools(components, {SetIndex(2)}), (SamplingPools{Sets({0, 5}), Sets({2})}));
  EXPECT_EQ(GoalPools(components, {SetIndex(2), SetIndex(4)}),
            (SamplingPools{Sets({0, 5}), Sets({2, 4})}));
}

TEST_F(DrawFromSetsOfASquare, GivesAGraspThatIsGoodWhereverItIs) {
  EXPECT_EQ(Draw({Sets({0, 1, 2, 3})}).size(), 2U);
  EXPECT_EQ(seen_.back(), SetIndex(3));
}

TEST_F(DrawFromSetsOfASquare, LooksAtTheSecondListOnlyWhereTheFirstHasNone) {
  Draw({Sets({0, 3}), Sets({1})});
  EXPECT_THAT(seen_, testing::Not(testing::Contains(SetIndex(1))));
  Draw({Sets({0, 2}), Sets({3})});
  EXPECT_THAT(seen_, testing::IsSupersetOf(Sets({0, 2, 3})));
}

TEST_F(DrawFromSetsOfASquare, SaysOfHowManySetsItFoundNone) {
  try {
    Draw({Sets({0, 1}), Sets({2})});
    FAIL() << "a grasp was drawn";
  } catch (const sampling::NoGrasp& none) {
    EXPECT_EQ(none.message,
              "goal: no grasp with a quality of at least 0.01 was drawn from 3 sets of grasps in "
              "the start's component");
  }
}

}  // namespace set_sampling_test
}  // namespace regrasp::sets
