#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/gait/successors.h"

namespace regrasp::gait {
namespace contact_kinds_test {

using Eigen::Vector3d;

TEST(ContactKindsTest, NearContactsOnOneSideAreOfAKind) {
  const std::vector<SurfacePoint> points = {{{0, 0, 0}, Vector3d::UnitZ()},
                                            {{0.01, 0, 0}, Vector3d::UnitZ()},
                                            {{0.05, 0, 0}, Vector3d::UnitZ()},
                                            {{0, 0, 0.002}, -Vector3d::UnitZ()}};
  const ContactClusters kinds(points);
  EXPECT_EQ(kinds.KindOf({0, kNone, 2}), kinds.KindOf({1, kNone, 2}));
  EXPECT_NE(kinds.KindOf({0, kNone, 2}), kinds.KindOf({2, kNone, 0}));
  EXPECT_NE(kinds.KindOf({0}), kinds.KindOf({2})) << "far off";
  EXPECT_NE(kinds.KindOf({0}), kinds.KindOf({3})) << "the other side of a sheet";
  EXPECT_NE(kinds.KindOf({0}), kinds.KindOf({kNone}));
}

}  // namespace contact_kinds_test
}  // namespace regrasp::gait
