#include <gtest/gtest.h>

#include "planner/gait/successors.h"

namespace regrasp::gait {
namespace crowding_test {

using Eigen::Vector3d;

/// Two places, 5 cm apart.
const std::vector<SurfacePoint> kPoints = {{{0, 0, 0}, Vector3d::UnitZ()},
                                           {{0.01, 0, 0}, Vector3d::UnitZ()},
                                           {{0.05, 0, 0}, Vector3d::UnitZ()}};

TEST(CrowdingTest, WhatIsLikeARestThatWasLookedAtIsPutBackTheFartherTheMoreItIs) {
  const ContactClusters kinds(kPoints);
  NoveltyPenalty crowding(kinds, 4);
  const ContactAssignment holding = {0, 2, kNone};
  EXPECT_EQ(crowding.PenaltyFor(7, holding, 3), 7);
  crowding.Count(holding, 3);
  const double same = crowding.PenaltyFor(7, holding, 3);
  const double kind_elsewhere = crowding.PenaltyFor(7, {1, 2, kNone}, 2);
  const double fingers_elsewhere = crowding.PenaltyFor(7, {2, 0, kNone}, 2);
  EXPECT_LT(same, kind_elsewhere);
  EXPECT_LT(kind_elsewhere, fingers_elsewhere);
  EXPECT_LT(fingers_elsewhere, 7);
  EXPECT_LT(crowding.PenaltyFor(7, {0, kNone, 2}, 3), 7) << "it ends at the same step";
  EXPECT_EQ(crowding.PenaltyFor(7, {0, kNone, 2}, 2), 7) << "nothing is alike";
}

TEST(CrowdingTest, EachOneThatIsCountedPutsBackByAsMuch) {
  const ContactClusters kinds(kPoints);
  NoveltyPenalty crowding(kinds, 0);
  const ContactAssignment holding = {0, 1, 2};
  crowding.Count(holding, 0);
  const double once = crowding.PenaltyFor(0, holding, 0);
  crowding.Count(holding, 0);
  EXPECT_DOUBLE_EQ(crowding.PenaltyFor(0, holding, 0), 2 * once);
}

}  // namespace crowding_test
}  // namespace regrasp::gait
