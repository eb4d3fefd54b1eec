#include <gtest/gtest.h>

#include "planner/roadmap/clustered_roadmap.h"

namespace regrasp::roadmap {
namespace find_contact_test {

TEST(FindContact, TakesTheFirstOnTheSameFaceWithinTheTolerance) {
  const Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  const std::vector<grasp::Contact> points = {{{0, 0, 0}, n, FaceIndex(4)},
                                              {{0, 0, 0}, n, FaceIndex(5)},
                                              {{1e-3, 0, 0}, n, FaceIndex(5)},
                                              {{1e-3, 1e-4, 0}, n, FaceIndex(5)}};
  const auto find = [&](const Eigen::Vector3d& p, int face, double tolerance) {
    return FindContact(points, {p, n, FaceIndex(face)}, tolerance);
  };
  EXPECT_EQ(find({0, 0, 0}, 4, 0), 0);
  EXPECT_EQ(find({0, 0, 0}, 5, 0), 1);
  EXPECT_EQ(find({1e-3, 1e-4, 0}, 5, 2e-4), 2);
  EXPECT_EQ(find({1e-3, 1e-4, 0}, 5, 1e-5), 3);
  EXPECT_EQ(find({0, 0, 0}, 6, 1), std::nullopt);
  EXPECT_EQ(find({0, 0, 1e-3}, 4, 1e-4), std::nullopt);
}

}  // namespace find_contact_test
}  // namespace regrasp::roadmap
