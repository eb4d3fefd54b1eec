#include "planner/gait/gait_search.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "tests/planner/gait/gait_requests.h"
#include "tests/planner/gait/gait_world.h"

namespace regrasp::gait {
namespace gait_search_test {

constexpr std::int64_t kBudget = 400;

/// Law: every segment begins where the previous one ends.
void ExpectContinuous(const Gait& gait) {
  const Keyframe* last = &gait.start;
  for (const PlanSegment& segment : gait.segments) {
    EXPECT_EQ(segment.path.front().pose.matrix(), last->pose.matrix());
    EXPECT_EQ(segment.path.front().configurations, last->configurations);
    last = &segment.path.back();
  }
}

void ExpectEqual(const Gait& a, const Gait& b) {
  EXPECT_EQ(a.initial, b.initial);
  EXPECT_EQ(a.start.configurations, b.start.configurations);
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    ASSERT_EQ(a.segments[i].path.size(), b.segments[i].path.size());
    for (std::size_t k = 0; k < a.segments[i].path.size(); ++k) {
      EXPECT_EQ(a.segments[i].path[k].configurations, b.segments[i].path[k].configurations);
    }
  }
}

/// The ring hand and a cube of 48 mm.
class GaitSearchTest : public testing::Test {
 protected:
  /// Return a track that rotates the object about z.
  [[nodiscard]] PoseTrack Rotation(double degrees) const {
    return ObjectTask(world_.task.centre(), {Eigen::Vector3d::UnitZ(), Radians(degrees)}, {})
        .From(pose_);
  }

  GaitWorld world_{RequestFor("cube", 0.8, 90)};
  const Eigen::Isometry3d pose_ = world_.BestPose();
};

/// Known answer: without a task the first admissible stance is the whole gait.
TEST_F(GaitSearchTest, WithoutATaskTheGaitIsOneStance) {
  WorldSearch one(world_, Rotation(0));
  EXPECT_FALSE(one.search.IsExhausted());
  const std::optional<Gait> gait = one.search.Run(kBudget, {});
  ASSERT_TRUE(gait);
  EXPECT_TRUE(gait->segments.empty());
  EXPECT_EQ(gait->start.pose.matrix(), pose_.matrix());
  EXPECT_EQ(CountHoldingFingers(gait->initial), 3);
  criteria::ContactSet contacts;
  for (const int number : ContactNumbers(gait->initial)) contacts.Insert(number);
  EXPECT_TRUE(world_.memory.Admits(contacts));
  EXPECT_EQ(one.search.counts().expanded, 0);
  EXPECT_EQ(one.search.counts().at_goal, 1);
}

/// Negative control: almost without friction no stance is admissible.
TEST_F(GaitSearchTest, WithoutFrictionNothingIsExpanded) {
  GaitRequest slippery = RequestFor("cube", 0.8, 90);
  slippery.criteria.friction_angle = Radians(0.01);
  GaitWorld world(slippery);
  WorldSearch none(world, Rotation(0));
  EXPECT_FALSE(none.search.Run(kBudget, {}));
  EXPECT_TRUE(none.search.IsExhausted());
  EXPECT_EQ(none.search.counts().expanded, 0);
  EXPECT_EQ(none.search.last_expanded(), -1);
}

TEST_F(GaitSearchTest, TheGaitLeadsFromTheStartOfTheGridToItsGoal) {
  WorldSearch turn(world_, Rotation(90));
  const std::optional<Gait> gait = turn.search.Run(kBudget, {});
  ASSERT_TRUE(gait);
  EXPECT_EQ(gait->start.pose.matrix(), turn.grid.PoseAt(turn.grid.start()).matrix());
  const Eigen::Isometry3d goal = turn.grid.PoseAt(turn.grid.goal());
  EXPECT_LT((EndOf(*gait).pose.linear() - goal.linear()).norm(), 1e-12);
  EXPECT_GT((EndOf(*gait).pose.linear() - gait->start.pose.linear()).norm(), 0.1);
  ExpectContinuous(*gait);
  // The last stance is popped, but not expanded.
  EXPECT_LE(turn.search.counts().expanded, kBudget);
  EXPECT_EQ(turn.search.counts().steps, turn.grid.steps());
}

/// Law: a search that is interrupted after each expansion gives the same gait.
TEST_F(GaitSearchTest, AnInterruptedSearchGivesTheSameGait) {
  WorldSearch whole(world_, Rotation(90));
  WorldSearch parts(world_, Rotation(90));
  const std::optional<Gait> gait = whole.search.Run(kBudget, {});
  ASSERT_TRUE(gait);
  std::optional<Gait> same;
  for (int n = 1; n <= kBudget && !same; ++n) {
    same = parts.search.Run(n, {});
    EXPECT_LE(parts.search.counts().expanded, n);
  }
  ASSERT_TRUE(same);
  ExpectEqual(*gait, *same);
  EXPECT_EQ(parts.search.counts().evaluated, whole.search.counts().evaluated);
}

TEST_F(GaitSearchTest, AnExpiredDeadlineEndsTheSearch) {
  WorldSearch turn(world_, Rotation(90));
  const Deadline::Clock::time_point now;
  EXPECT_FALSE(turn.search.Run(kBudget, Deadline(now, [now] { return now; })));
  EXPECT_EQ(turn.search.counts().expanded, 0);
}

TEST_F(GaitSearchTest, AGivenStanceIsTheRoot) {
  WorldSearch first(world_, Rotation(90));
  const std::optional<Gait> gait = first.search.Run(kBudget, {});
  ASSERT_TRUE(gait);
  WorldSearch again(world_, Rotation(90));
  again.search.StartFrom({gait->initial, gait->start.configurations});
  const std::optional<Gait> from_stance = again.search.Run(kBudget, {});
  ASSERT_TRUE(from_stance);
  EXPECT_EQ(from_stance->initial, gait->initial);
  EXPECT_EQ(again.search.StanceOf(0).assignment, gait->initial);
  for (int index = 0; index <= again.search.last_expanded(); ++index) {
    EXPECT_EQ(again.search.RootOf(index), 0);
  }
}

/// Known answers: a simulator that rejects every initial grasp, and one that accepts everything.
TEST_F(GaitSearchTest, OnlyGaitsThatExecuteAreReturned) {
  int simulated = 0;
  WorldSearch rejected(world_, Rotation(0));
  rejected.search.SimulateEdges([&](const Gait&) {
    ++simulated;
    return GaitExecution{.is_held = false, .reason = plan::Reason::kSlipped};
  });
  EXPECT_FALSE(rejected.search.Run(20, {}));
  EXPECT_GT(simulated, 1);
  const FailureCounts failures = rejected.search.counts().execution_failures;
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures.at(plan::Reason::kSlipped), simulated);

  simulated = 0;
  WorldSearch accepted(world_, Rotation(0));
  accepted.search.SimulateEdges([&](const Gait&) {
    ++simulated;
    return GaitExecution{.is_whole = true};
  });
  EXPECT_TRUE(accepted.search.Run(20, {}));
  EXPECT_EQ(simulated, 1);
  EXPECT_TRUE(accepted.search.counts().execution_failures.empty());
}

TEST_F(GaitSearchTest, AGoalGraspMustBeWithinReachAtTheGoal) {
  WorldSearch free(world_, Rotation(0));
  EXPECT_TRUE(free.search.GoalIsHeld());
  const std::optional<Gait> gait = free.search.Run(kBudget, {});
  ASSERT_TRUE(gait);
  const std::vector<int> held = ContactNumbers(gait->initial);
  WorldSearch reachable(world_, Rotation(0), {{}, held});
  EXPECT_TRUE(reachable.search.GoalIsHeld());

  const auto is_reached = [&](int point) {
    for (FingerIndex finger{0}; finger < world_.scene.finger_count(); ++finger) {
      if (free.checker.reach().Find(finger, point, free.grid.start()) != nullptr) return true;
    }
    return false;
  };
  int unreachable = 0;
  while (unreachable < kWorldContacts && is_reached(unreachable)) ++unreachable;
  ASSERT_LT(unreachable, kWorldContacts);
  WorldSearch out_of_reach(world_, Rotation(0), {{}, {held[0], held[1], unreachable}});
  EXPECT_FALSE(out_of_reach.search.GoalIsHeld());
}

}  // namespace gait_search_test
}  // namespace regrasp::gait
