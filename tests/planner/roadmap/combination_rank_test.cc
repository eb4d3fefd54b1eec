#include <gtest/gtest.h>

#include <set>

#include "planner/roadmap/roadmap.h"

namespace regrasp::roadmap {
namespace combination_rank_test {

TEST(Binomial, KnowsPascalsTriangle) {
  EXPECT_EQ(Binomial<4>(3), 0);
  EXPECT_EQ(Binomial<4>(4), 1);
  EXPECT_EQ(Binomial<4>(60), 487'635);
  EXPECT_EQ(Binomial<4>(70), 916'895);
}

TEST(CombinationRank, IsABijectionOntoTheFirstNumbers) {
  constexpr int kThings = 9;
  std::set<std::int64_t> ranks;
  for (int a = 0; a < kThings; ++a) {
    for (int b = a + 1; b < kThings; ++b) {
      for (int c = b + 1; c < kThings; ++c) {
        ranks.insert(CombinationRank({a, b, c}));
      }
    }
  }
  EXPECT_EQ(std::ssize(ranks), Binomial<3>(kThings));
  EXPECT_EQ(*ranks.begin(), 0);
  EXPECT_EQ(*ranks.rbegin(), Binomial<3>(kThings) - 1);
}

}  // namespace combination_rank_test
}  // namespace regrasp::roadmap
