#include "planner/gait/pose_grid.h"

#include <gtest/gtest.h>

namespace regrasp::gait {
namespace pose_grid_test {

using Eigen::Vector3d;

/// Law: the reversed grid has the same poses.
TEST(PoseGridTest, AReversedGridHasTheSamePoses) {
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.translation() = Vector3d(0.01, -0.02, 0.1);
  start.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const int steps : {0, 1, 7}) {
    const PoseTrack track(start, {0.003, 0.001, -0.002}, {Vector3d::UnitY(), steps == 0 ? 0 : 1.1},
                          steps == 0 ? Vector3d::Zero() : Vector3d(0.01, 0.02, 0), steps);
    const PoseGrid grid(track, Vector3d(0, 0.6, 0.8), PoseGrid::End::kPose);
    const PoseGrid reversed = grid.Reversed();
    ASSERT_EQ(grid.size(), reversed.size());
    EXPECT_EQ(grid.Mirrored(grid.start()), reversed.goal());
    for (int node = 0; node < grid.size(); ++node) {
      const int mirrored = grid.Mirrored(node);
      EXPECT_EQ(reversed.Mirrored(mirrored), node);
      EXPECT_LT((grid.PoseAt(node).matrix() - reversed.PoseAt(mirrored).matrix()).norm(), 1e-12);
      EXPECT_EQ(grid.Neighbours(node).size(), reversed.Neighbours(mirrored).size());
    }
  }
}

/// Law: a forward and a backward part with equal tilt add up to the whole rotation; with different
/// tilts they do not.
TEST(PoseGridTest, ForwardAndBackwardPartsWithEqualTiltAddUpToTheRotation) {
  constexpr int kSteps = 5;
  const Turn turn{Vector3d(1, -1, 2).normalized(), 1.3};
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const PoseTrack track(start, {0.01, 0, 0}, turn, Vector3d::Zero(), kSteps);
  const Vector3d up = Vector3d::UnitZ();
  const PoseGrid forward(track, up, PoseGrid::End::kOrientation);
  const PoseGrid backward(track.Backwards(), up, PoseGrid::End::kOrientation);
  ASSERT_EQ(forward.PoseAt(forward.start()).matrix(), backward.PoseAt(backward.start()).matrix());
  const Eigen::Matrix3d whole = Eigen::AngleAxisd(turn.angle, turn.axis).toRotationMatrix();
  int equal_tilts = 0;
  for (int node = 0; node < forward.size(); ++node) {
    for (int back = 0; back < backward.size(); ++back) {
      if (forward.StepOf(node) + backward.StepOf(back) != kSteps) continue;
      const Eigen::Matrix3d between =
          backward.PoseAt(back).linear().transpose() * forward.PoseAt(node).linear();
      const bool same_tilt = forward.TiltOf(node) == backward.TiltOf(back);
      EXPECT_EQ((between - whole).norm() < 1e-12, same_tilt) << node << " " << back;
      equal_tilts += same_tilt;
    }
  }
  EXPECT_GT(equal_tilts, forward.size());
}

/// Tracks of a facing goal end in the goal set, and rotate the object about its centre.
TEST(PoseGridTest, TracksEndInsideTheGoalSet) {
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.translation() = Vector3d(0.01, -0.02, 0.1);
  start.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3d centre(0.003, 0.001, -0.002);
  const plan::GoalSet goal(plan::FacingGoal{Vector3d::UnitX(), Vector3d::UnitZ(), 0.5});
  const ObjectTask task(centre, {}, goal);
  const std::vector<PoseTrack> tracks = task.Tracks(start);
  EXPECT_GT(tracks.size(), 1u);
  for (const PoseTrack& track : tracks) {
    const Eigen::Isometry3d end = track.PoseAt(track.steps());
    EXPECT_TRUE(goal.Contains(end));
    EXPECT_FALSE(goal.Shrunk(0, Radians(3)).Contains(end));
    EXPECT_LT((end * centre - start * centre).norm(), 1e-12);
    const PoseGrid grid(track, Vector3d::UnitZ(), goal);
    int goals = 0;
    for (int node = 0; node < grid.size(); ++node) {
      if (!grid.IsGoal(node)) continue;
      ++goals;
      EXPECT_TRUE(goal.Contains(grid.PoseAt(node)));
    }
    EXPECT_GT(goals, 1);
  }
  EXPECT_LE(std::abs(tracks[0].turn().angle), std::abs(tracks[1].turn().angle));
}

/// A goal pose after a rotation of 160° is also the end of a rotation by −200°.
TEST(PoseGridTest, LargeRotationsToAGoalPoseHaveTracksInBothDirections) {
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.translation() = Vector3d(0.01, -0.02, 0.1);
  const Vector3d centre(0.003, 0.001, -0.002);
  for (const double degrees : {80.0, 160.0, 180.0}) {
    Eigen::Isometry3d end = start * Eigen::AngleAxisd(Radians(degrees), Vector3d::UnitZ());
    end.translation() += Vector3d(0.004, 0, 0.002);
    const ObjectTask task(centre, {}, plan::GoalSet(plan::PoseGoal{end, {}, centre}));
    const std::vector<PoseTrack> tracks = task.Tracks(start);
    ASSERT_EQ(tracks.size(), degrees > 90 ? 2u : 1u);
    for (const PoseTrack& track : tracks) {
      EXPECT_TRUE(track.PoseAt(0).isApprox(start, 1e-12));
      EXPECT_TRUE(track.PoseAt(track.steps()).isApprox(end, 1e-9));
    }
    if (tracks.size() == 1) continue;
    EXPECT_NEAR(tracks[0].turn().angle - tracks[1].turn().angle, Radians(360), 1e-9);
    EXPECT_GE(tracks[1].steps(), tracks[0].steps());
    const Vector3d half = tracks[1].PoseAt(0.5 * tracks[1].steps()).linear() * Vector3d::UnitX();
    EXPECT_NEAR(half.dot(tracks[0].PoseAt(0.5 * tracks[0].steps()).linear() * Vector3d::UnitX()),
                -1, 1e-9);
  }
}

TEST(ObjectTaskTest, AShiftIsAlongTheAxesOfTheObjectAtTheStart) {
  const Eigen::Isometry3d start =
      Eigen::Translation3d(0.1, 0, 0) * Eigen::AngleAxisd(Radians(90), Vector3d::UnitZ());
  const Vector3d centre(0.01, 0, 0), shift(0.02, 0, 0);
  const planning::Turn turn{Vector3d::UnitX(), Radians(30)};
  constexpr double kRounding = 1e-12;        // metres
  constexpr double kRoundingOfAngle = 1e-7;  // radians; the square root of rounding near zero
  for (const bool turns : {true, false}) {
    const ObjectTask task(centre, turns ? turn : planning::Turn{}, {}, {}, shift);
    const PoseTrack track = task.From(start, 4);
    EXPECT_EQ(track.steps(), 4);
    const Eigen::Isometry3d end = track.PoseAt(4);
    EXPECT_LT((end * centre - start * (centre + shift)).norm(), kRounding);
    EXPECT_NEAR(Eigen::AngleAxisd(start.linear().transpose() * end.linear()).angle(),
                turns ? turn.angle : 0, kRoundingOfAngle);
  }
  EXPECT_EQ(ObjectTask(centre, {}, {}).From(start, 4).steps(), 0);
}

/// A full rotation begins in its goal set, but only its end is a goal.
TEST(PoseGridTest, AFullRotationEndsAfterAllButItsTolerance) {
  const Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  const Turn turn{Vector3d::UnitZ(), Radians(360)};
  const ObjectTask task(Vector3d::Zero(), turn, {}, plan::PoseTolerance{0.01, Radians(20)});
  const PoseTrack track = task.From(start);
  EXPECT_NEAR(track.turn().angle, Radians(342), 1e-9);
  const PoseGrid grid(track, Vector3d::UnitZ(), *task.GoalFrom(start));
  EXPECT_FALSE(grid.IsGoal(grid.start()));
  EXPECT_TRUE(grid.IsGoal(grid.goal()));
  EXPECT_FALSE(ObjectTask(Vector3d::Zero(), turn, {}).GoalFrom(start));
}

}  // namespace pose_grid_test
}  // namespace regrasp::gait
