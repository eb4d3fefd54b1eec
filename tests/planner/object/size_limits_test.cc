#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "planner/object/weld.h"

namespace regrasp::object {
namespace size_limits_test {

using testing::HasSubstr;

TEST(SizeComplaint, OfObjectsThatAreTooSmallOrTooFarAway) {
  const auto complaint = [](double place, double diameter) {
    return SizeComplaint({{0, 0, 0}, {place, 0, 0}}, diameter);
  };
  EXPECT_EQ(complaint(1, 1), "");
  EXPECT_EQ(complaint(kMaxOffset, 1), "");
  EXPECT_THAT(complaint(1.01 * kMaxOffset, 1), HasSubstr("too far from the origin"));
  EXPECT_EQ(complaint(1.01 * kMaxOffset, 1.02), "");
  EXPECT_EQ(complaint(0, kMinDiameter), "");
  for (const double small : {kMinDiameter / 2, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(complaint(0, small), HasSubstr("all vertices lie within"));
  }
}

TEST(EdgeComplaint, OfEdgesWhoseProductsWouldUnderflow) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  EXPECT_EQ(EdgeComplaint(origin, {2 * kMinEdge, 0, 0}, 1), "");
  EXPECT_THAT(EdgeComplaint(origin, {kMinEdge / 2, 0, 0}, 1), HasSubstr("merge its ends"));
  EXPECT_THAT(EdgeComplaint(origin, {2 * kMinEdge, 0, 0}, 4), HasSubstr("shorter"));
  EXPECT_THAT(EdgeComplaint(origin, origin, 1), HasSubstr("shorter (0)"));
  // The square of this length underflows.
  EXPECT_EQ(EdgeComplaint(origin, {1e-180, 1e-180, 0}, 1e-160), "");
}

}  // namespace size_limits_test
}  // namespace regrasp::object
