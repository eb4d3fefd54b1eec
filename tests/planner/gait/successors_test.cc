#include "planner/gait/successors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace regrasp::gait {
namespace successors_test {

using Eigen::Vector3d;

TEST(ContactClustersTest, NearbyContactsOnOneSideShareACluster) {
  const std::vector<SurfacePoint> points = {{{0, 0, 0}, Vector3d::UnitZ()},
                                            {{0.01, 0, 0}, Vector3d::UnitZ()},
                                            {{0.05, 0, 0}, Vector3d::UnitZ()},
                                            {{0, 0, 0.002}, -Vector3d::UnitZ()}};
  const ContactClusters clusters(points);
  EXPECT_EQ(clusters.ClustersOf({0, kNone, 2}), clusters.ClustersOf({1, kNone, 2}));
  EXPECT_NE(clusters.ClustersOf({0, kNone, 2}), clusters.ClustersOf({2, kNone, 0}));
  EXPECT_NE(clusters.ClustersOf({0}), clusters.ClustersOf({2})) << "far off";
  EXPECT_NE(clusters.ClustersOf({0}), clusters.ClustersOf({3})) << "the other side of a sheet";
  EXPECT_NE(clusters.ClustersOf({0}), clusters.ClustersOf({kNone}));
}

/// Two clusters, 5 cm apart.
const std::vector<SurfacePoint> kPoints = {{{0, 0, 0}, Vector3d::UnitZ()},
                                           {{0.01, 0, 0}, Vector3d::UnitZ()},
                                           {{0.05, 0, 0}, Vector3d::UnitZ()}};

TEST(NoveltyPenaltyTest, ThePenaltyGrowsWithSimilarity) {
  const ContactClusters clusters(kPoints);
  NoveltyPenalty penalty(clusters, 4);
  const ContactAssignment assignment = {0, 2, kNone};
  EXPECT_EQ(penalty.Penalized(7, assignment, 3), 7);
  penalty.Count(assignment, 3);
  const double same = penalty.Penalized(7, assignment, 3);
  const double kind_elsewhere = penalty.Penalized(7, {1, 2, kNone}, 2);
  const double fingers_elsewhere = penalty.Penalized(7, {2, 0, kNone}, 2);
  EXPECT_LT(same, kind_elsewhere);
  EXPECT_LT(kind_elsewhere, fingers_elsewhere);
  EXPECT_LT(fingers_elsewhere, 7);
  EXPECT_LT(penalty.Penalized(7, {0, kNone, 2}, 3), 7) << "it ends at the same step";
  EXPECT_EQ(penalty.Penalized(7, {0, kNone, 2}, 2), 7) << "nothing is alike";
}

TEST(NoveltyPenaltyTest, ThePenaltyIsProportionalToTheCount) {
  const ContactClusters clusters(kPoints);
  NoveltyPenalty penalty(clusters, 0);
  const ContactAssignment assignment = {0, 1, 2};
  penalty.Count(assignment, 0);
  const double once = penalty.Penalized(0, assignment, 0);
  penalty.Count(assignment, 0);
  EXPECT_DOUBLE_EQ(penalty.Penalized(0, assignment, 0), 2 * once);
}

}  // namespace successors_test
}  // namespace regrasp::gait
