#include "render/figures/contact_space_track.h"

#include <gmock/gmock.h>

#include "tests/render/figures/contact_space_scenes.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace contact_space_track_test {

using testing::SizeIs;

TEST(ContactSpaceTrackTest, AContactThatStaysKeepsItsAxisAndAPlacedOneTakesTheOther) {
  const object::Polygon fork = MakeFork();
  const contour::Boundary boundary(fork);
  const std::vector<TrackEntry> track = TrackPlan(MakeForkPlan());
  ASSERT_THAT(track, SizeIs(3));
  const Eigen::Vector2d expected[] = {{18, 46}, {18, 25}, {39, 25}};
  for (int i = 0; i < 3; ++i) {
    const SpacePoint point = PointOf(boundary, track[i].grasp);
    EXPECT_LT((point.places - expected[i]).norm(), 1e-12) << i << ": " << point.places.transpose();
  }
  EXPECT_EQ(track[0].shared_axis, std::nullopt);
  EXPECT_EQ(track[1].shared_axis, 0);
  EXPECT_EQ(track[2].shared_axis, 1);
}

TEST(ContactSpaceTrackTest, TheInitialGraspHasItsLowerEdgeAcrossWhicheverFingerHoldsIt) {
  const object::Polygon fork = MakeFork();
  plan::Plan plan = MakeForkPlan();
  std::swap(plan.initial[0], plan.initial[1]);
  EXPECT_EQ(TrackPlan(plan).front().grasp[0].contact.face, 1);
}

TEST(ContactSpaceTrackTest, AWaypointHasTheAxesOfTheGraspBefore) {
  const object::Polygon disc = MakeDisc(12);
  plan::Plan plan = MakeDiscPlan(disc);
  auto& waypoints = std::get<plan::Align>(plan.steps[0]).waypoints;
  std::swap(waypoints[2][0], waypoints[2][1]);  // the order in a file is arbitrary
  const std::vector<TrackEntry> track = TrackPlan(plan);
  ASSERT_THAT(track, SizeIs(2));
  ASSERT_THAT(track[1].path, SizeIs(4));
  for (const AxisGrasp& grasp : track[1].path) {
    EXPECT_EQ(grasp[0].finger, track[0].grasp[0].finger);
    EXPECT_EQ(grasp[1].finger, track[0].grasp[1].finger);
  }
}

TEST(ContactSpaceTrackTest, NoContactStaysIfBothAreExchanged) {
  const std::vector<TrackEntry> track = TrackPlan(MakeExchangePlan());
  ASSERT_THAT(track, SizeIs(2));
  EXPECT_EQ(track[1].shared_axis, std::nullopt);
  EXPECT_STREQ(track[1].kind, "switch");
}

TEST(ContactSpaceTrackTest, FindsTheFirstGraspOfOtherThanTwoContacts) {
  EXPECT_EQ(FindOtherThanTwoContacts(MakeForkPlan()), std::nullopt);
  EXPECT_EQ(FindOtherThanTwoContacts(MakeExchangePlan()), std::nullopt);
  EXPECT_EQ(FindOtherThanTwoContacts(MakeSquarePlan()), (StaticGraspSize{plan::EntryIndex(0), 3}));
  plan::Plan plan = MakeForkPlan();
  std::get<plan::Switch>(plan.steps[1]).release.clear();
  EXPECT_EQ(FindOtherThanTwoContacts(plan), (StaticGraspSize{plan::EntryIndex(2), 3}));
}

}  // namespace contact_space_track_test
}  // namespace regrasp::render
