#include "planner/gait/pose_grid.h"

#include <gtest/gtest.h>

namespace regrasp::gait {
namespace {

using Eigen::Vector3d;

/// From its end an object passes the same poses.
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

}  // namespace
}  // namespace regrasp::gait
