#include "planner/gait/joined_search.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "tests/planner/gait/gait_requests.h"
#include "tests/planner/gait/gait_world.h"

namespace regrasp::gait {
namespace joined_search_test {

constexpr std::int64_t kBudget = 400;

IdleConfigurations IdleConfigurationsFor(const GaitWorld& world, const PoseTrack& track) {
  RandomStream random(1, RandomUse::kHomes);
  return FindIdleConfigurations(world.setup, track, random).value();
}

/// The ring hand holds a cube of 48 mm, which stays where it is.
class BidirectionalSearchTest : public testing::Test {
 protected:
  BidirectionalSearchTest() {
    GaitWorld world(request_);
    pose_ = world.BestPose();
    WorldSearch one(world, world.task.From(pose_));
    const std::vector<int> held = ContactNumbers(one.search.Run(kBudget, {}).value().initial);
    for (const int number : held) {
      nearby_.push_back(world.contacts[number]);
      // 1.2 mm away on the same face.
      nearby_.back().p += 0.0015 * nearby_.back().n.unitOrthogonal();
    }
    start_ = held;
    for (int i = 0; i < 3; ++i) goal_.push_back(kWorldContacts + i);
  }

  std::optional<Gait> Search(GaitWorld& world, const GaitEnds& ends, std::int64_t budget = kBudget,
                             bool* goal_is_held = nullptr) {
    const PoseTrack track = world.task.From(pose_);
    const PoseGrid grid(track, world.scene.hand().up, PoseGrid::End::kPose);
    RandomStream random(1, RandomUse::kGaits);
    BidirectionalSearch search(world.setup, grid, IdleConfigurationsFor(world, track), ends,
                               world.memory, random, {});
    if (goal_is_held != nullptr) *goal_is_held = search.GoalIsHeld();
    std::optional<Gait> gait = search.Run(budget, {});
    expanded_ = search.counts().expanded;
    EXPECT_LE(expanded_, budget + 1);
    return gait;
  }

  const GaitRequest request_ = RequestFor("cube", 0.8, 0);
  Eigen::Isometry3d pose_;
  grasp::Grasp nearby_;  ///< contacts of the goal
  std::vector<int> start_;
  std::vector<int> goal_;
  std::int64_t expanded_ = 0;  ///< expansions of the last search
};

std::vector<int> Sorted(std::vector<int> numbers) {
  std::ranges::sort(numbers);
  return numbers;
}

/// Known answer: all three fingers slide at once, in both directions of time.
TEST_F(BidirectionalSearchTest, ANearbyGraspIsOneSlidingStepAway) {
  GaitWorld world(request_, nearby_);
  for (const bool is_reversed : {false, true}) {
    const std::vector<int>& from = is_reversed ? goal_ : start_;
    const std::vector<int>& to = is_reversed ? start_ : goal_;
    const std::optional<Gait> gait = Search(world, {from, to});
    ASSERT_TRUE(gait);
    EXPECT_EQ(Sorted(ContactNumbers(gait->initial)), Sorted(from));
    EXPECT_EQ(Sorted(ContactNumbers(AssignmentAtEnd(*gait))), Sorted(to));
    EXPECT_EQ(EndOf(*gait).pose.matrix(), pose_.matrix());
    int slides = 0;
    for (const PlanSegment& segment : gait->segments) {
      if (segment.kind != PlanSegment::Kind::kSlide) continue;
      ++slides;
      EXPECT_EQ(segment.slid.size(), 3U);
    }
    EXPECT_EQ(slides, 1);
  }
}

/// Negative control: fingers that must not slide need more expansions.
TEST_F(BidirectionalSearchTest, WithoutSlidingANearbyGraspIsFarAway) {
  GaitWorld world(request_, nearby_);
  EXPECT_TRUE(Search(world, {start_, goal_}));
  world.setup.may_slide = false;
  EXPECT_FALSE(Search(world, {start_, goal_}, expanded_));
}

/// Known answer: equal ends need no segment.
TEST_F(BidirectionalSearchTest, EqualEndsNeedNoSegment) {
  GaitWorld world(request_, nearby_);
  const std::optional<Gait> gait = Search(world, {start_, start_});
  ASSERT_TRUE(gait);
  EXPECT_TRUE(gait->segments.empty());
}

TEST_F(BidirectionalSearchTest, AGoalGraspOutOfReachIsDetected) {
  bool is_held = false;
  {
    GaitWorld world(request_, nearby_);
    EXPECT_TRUE(Search(world, {start_, goal_}, kBudget, &is_held));
    EXPECT_TRUE(is_held);
  }
  // Negative control: the other three contacts are at one point.
  grasp::Grasp same(3, nearby_.front());
  GaitWorld world(request_, same);
  EXPECT_FALSE(Search(world, {start_, goal_}, 2, &is_held));
  EXPECT_FALSE(is_held);
}

/// The ring hand rotates a cube of 48 mm about z.
class TurnSearchTest : public testing::Test {
 protected:
  static constexpr double kDegrees = 150;

  std::optional<Gait> Search(GaitWorld& world, const PoseTrack& track, std::uint64_t seed) {
    RandomStream random(seed, RandomUse::kGaits);
    TurnSearch search(world.setup, track, IdleConfigurationsFor(world, track),
                      IdleConfigurationsFor(world, track.Backwards()), world.memory, random);
    std::optional<Gait> gait = search.Run(kBudget, {});
    EXPECT_TRUE(search.GoalIsHeld());
    EXPECT_LE(search.counts().farthest, track.steps());
    EXPECT_EQ(search.counts().steps, track.steps());
    is_exhausted_ = search.IsExhausted();
    return gait;
  }

  GaitWorld world_{RequestFor("cube", 0.8, kDegrees)};
  const PoseTrack track_ = world_.task.From(world_.BestPose());
  bool is_exhausted_ = false;
};

/// Law: start and end differ by the required rotation, wherever the gait begins.
TEST_F(TurnSearchTest, TheObjectRotatesByTheRequiredAngleFromAnyStart) {
  const Eigen::Matrix3d required =
      Eigen::AngleAxisd(Radians(kDegrees), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  int elsewhere = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const std::optional<Gait> gait = Search(world_, track_, seed);
    ASSERT_TRUE(gait) << seed;
    const Eigen::Matrix3d turned =
        gait->start.pose.linear().transpose() * EndOf(*gait).pose.linear();
    EXPECT_LT((turned - required).norm(), 1e-12);
    const bool is_start = gait->start.pose.isApprox(track_.PoseAt(0), 1e-9);
    elsewhere += static_cast<int>(!is_start);
    const Keyframe* last = &gait->start;
    for (const PlanSegment& segment : gait->segments) {
      EXPECT_EQ(segment.path.front().pose.matrix(), last->pose.matrix());
      last = &segment.path.back();
    }
  }
  // Negative control: a search in one direction would always begin at the start of the track.
  EXPECT_GT(elsewhere, 0);
}

/// Negative control: almost without friction there is no stance to begin with.
TEST_F(TurnSearchTest, WithoutFrictionTheSearchIsExhausted) {
  GaitRequest slippery = RequestFor("cube", 0.8, kDegrees);
  slippery.criteria.friction_angle = Radians(0.01);
  GaitWorld world(slippery);
  EXPECT_FALSE(Search(world, track_, 1));
  EXPECT_TRUE(is_exhausted_);
}

}  // namespace joined_search_test
}  // namespace regrasp::gait
