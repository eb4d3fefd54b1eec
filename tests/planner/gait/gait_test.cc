#include "planner/gait/gait.h"

#include <gtest/gtest.h>

namespace regrasp::gait {
namespace gait_test {

Keyframe At(double drive) {
  return {Eigen::Isometry3d::Identity(), {kinematics::JointConfiguration::Constant(1, drive)}};
}

/// Finger 1 is placed at contact 7, finger 0 leaves contact 4, finger 1 slides to 9.
Gait Example() {
  using Kind = PlanSegment::Kind;
  Gait gait{{4, kNone}, At(0), {}};
  gait.segments.push_back({Kind::kPlace, FingerIndex{1}, 7, {At(0), At(1)}});
  gait.segments.push_back({Kind::kRelease, FingerIndex{0}, 4, {At(1), At(2), At(3)}});
  PlanSegment slide{Kind::kSlide, {}, kNone, {At(3), At(4), At(5), At(6)}};
  slide.slid = {{FingerIndex{1}, 7, 9}};
  for (const double x : {1, 2, 3})
    slide.waypoints.push_back({grasp::Contact{{x, 0, 0}, {0, 0, 1}}});
  slide.waypoint_frames = {0, 1, 3};
  gait.segments.push_back(slide);
  return gait;
}

TEST(GaitTest, TheEndFollowsFromTheSegments) {
  EXPECT_EQ(AssignmentAtEnd(Example()), (ContactAssignment{kNone, 9}));
  EXPECT_EQ(EndOf(Example()).configurations[0][0], 6);
  EXPECT_EQ(EndOf(Gait{{4}, At(8), {}}).configurations[0][0], 8);
}

TEST(GaitTest, TheReversedGaitLeadsBack) {
  const Gait gait = Example();
  Gait back{AssignmentAtEnd(gait), EndOf(gait), {}};
  AppendReversed(gait.segments, back);
  EXPECT_EQ(AssignmentAtEnd(back), gait.initial);
  EXPECT_EQ(EndOf(back).configurations, gait.start.configurations);
  EXPECT_EQ(back.segments.front().slid[0].to, 7);
  EXPECT_EQ(back.segments.front().waypoints.front()[0].p.x(), 3);
  EXPECT_EQ(back.segments.front().waypoint_frames, (std::vector{0, 2, 3}));
  EXPECT_EQ(back.segments[1].kind, PlanSegment::Kind::kPlace);
  EXPECT_EQ(back.segments[2].kind, PlanSegment::Kind::kRelease);
  const Keyframe* last = &back.start;
  for (const PlanSegment& segment : back.segments) {
    EXPECT_EQ(segment.path.front().configurations, last->configurations);
    last = &segment.path.back();
  }
}

}  // namespace gait_test
}  // namespace regrasp::gait
