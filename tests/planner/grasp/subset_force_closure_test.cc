#include "planner/grasp/subset_force_closure.h"

#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace subset_force_closure_test {

using Subsets = std::vector<std::array<int, 4>>;

Subsets OneByOne(const Grasp& points, double friction_angle) {
  Subsets found;
  const int count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      for (int k = j + 1; k < count; ++k) {
        for (int l = k + 1; l < count; ++l) {
          const std::array grasp{points[i], points[j], points[k], points[l]};
          if (IsForceClosure(grasp, UnitFrame(3), friction_angle)) found.push_back({i, j, k, l});
        }
      }
    }
  }
  return found;
}

TEST(SubsetForceClosureTest, GivesWhatTheTestSaysOfEachSubset) {
  RandomGrasps random(31);
  for (const int count : {1, 3, 4, 5, 17, 40}) {
    for (const double degrees : {8.0, 15.0, 40.0}) {
      const Grasp ball = random.OnBall(count, 3);
      const Grasp box = random.OnBox(count, 3);
      EXPECT_EQ(ForceClosureSubsets(ball, UnitFrame(3), Radians(degrees)),
                OneByOne(ball, Radians(degrees)));
      EXPECT_EQ(ForceClosureSubsets(box, UnitFrame(3), Radians(degrees)),
                OneByOne(box, Radians(degrees)));
    }
  }
}

TEST(SubsetForceClosureTest, IndicesBeyondOneWordOfBitsAreRight) {
  RandomGrasps random(32);
  Grasp points = random.OnBall(67, 3);
  SubsetCounts counts;
  const Subsets found = ForceClosureSubsets(points, UnitFrame(3), Radians(12), &counts);
  int beyond = 0;
  for (const auto& [i, j, k, l] : found) {
    const std::array grasp{points[i], points[j], points[k], points[l]};
    EXPECT_TRUE(IsForceClosure(grasp, UnitFrame(3), Radians(12)));
    beyond += l >= 64;
  }
  EXPECT_GT(beyond, 100);
  EXPECT_EQ(counts.subsets, 766480);  // binomial coefficient of 67 over 4
  EXPECT_EQ(counts.subsets, counts.rejected_by_lines + counts.accepted_by_pairs +
                                counts.accepted_by_triples + counts.rejected_by_twists +
                                counts.by_simplex);
  EXPECT_GT(counts.rejected_by_twists, counts.by_simplex);
  EXPECT_EQ(found.size(), OneByOne(points, Radians(12)).size());
}

TEST(SubsetForceClosureTest, GridPointsWithCollinearAndCoincidentOnesAreRight) {
  RandomGrasps random(33);
  Grasp points = random.OnBox(30, 3);
  for (Contact& contact : points) contact.p = contact.p.array().round();
  const Subsets found = ForceClosureSubsets(points, UnitFrame(3), Radians(20));
  EXPECT_EQ(found, OneByOne(points, Radians(20)));
  EXPECT_GT(found.size(), 100U);
}

TEST(SubsetForceClosureTest, BadArgumentsThrow) {
  RandomGrasps random(34);
  EXPECT_THROW((void)ForceClosureSubsets({}, UnitFrame(3), 0.3), std::invalid_argument);
  EXPECT_THROW((void)ForceClosureSubsets(random.OnBall(5, 2), UnitFrame(2), 0.3),
               std::invalid_argument);
  EXPECT_THROW((void)ForceClosureSubsets(random.OnBall(5, 3), UnitFrame(3), -1),
               std::invalid_argument);
}

}  // namespace subset_force_closure_test
}  // namespace regrasp::grasp
