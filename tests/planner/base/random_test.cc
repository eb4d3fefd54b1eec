#include "planner/base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace regrasp {
namespace random_test {

TEST(RandomStream, GivesTheSameNumbersForTheSameSeedAndUse) {
  RandomStream a(7, RandomUse::kStart);
  RandomStream b(7, RandomUse::kStart);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.Uniform(), b.Uniform());
}

TEST(RandomStream, GivesOtherNumbersForAnotherSeedOrUse) {
  const double first = RandomStream(7, RandomUse::kStart).Uniform();
  EXPECT_NE(first, RandomStream(8, RandomUse::kStart).Uniform());
  EXPECT_NE(first, RandomStream(7, RandomUse::kGoal).Uniform());
  EXPECT_NE(first, RandomStream(7 + (std::uint64_t{1} << 32), RandomUse::kStart).Uniform());
}

TEST(RandomStream, GivesOtherNumbersForEveryIndexAndTheSameForTheSame) {
  const auto first = [](std::uint64_t index) {
    return RandomStream(7, RandomUse::kTrialWorld, index).Uniform();
  };
  EXPECT_EQ(first(3), first(3));
  EXPECT_NE(first(0), first(1));
  EXPECT_NE(first(0), first(std::uint64_t{1} << 32));
  EXPECT_NE(first(0), RandomStream(7, RandomUse::kTrialWorld).Uniform());
}

TEST(RandomStream, DrawsNormalNumbersOfMeanZeroAndDeviationOne) {
  constexpr int kDraws = 30'000;
  RandomStream random(1, RandomUse::kTrialContacts);
  double sum = 0, squares = 0;
  int beyond = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Normal();
    sum += x;
    squares += x * x;
    beyond += std::abs(x) > 1.959964 ? 1 : 0;
  }
  // The tolerances are five standard deviations.
  EXPECT_NEAR(sum / kDraws, 0, 5 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1, 5 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(beyond, 0.05 * kDraws, 5 * std::sqrt(0.05 * 0.95 * kDraws));
}

TEST(RandomStream, SpreadsEvenly) {
  constexpr int kDraws = 30'000;
  RandomStream random(1, RandomUse::kContactPoints);
  double sum = 0;
  std::array<int, 3> counts = {};
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    sum += x;
    ++counts.at(random.Index(counts.size()));
  }
  // The tolerances are five standard deviations of the mean and of a binomial count.
  EXPECT_NEAR(sum / kDraws, 0.5, 5 * 0.2887 / std::sqrt(kDraws));
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 3, 5 * std::sqrt(kDraws * 2 / 9.0));
}

TEST(RandomStream, DrawsTheOnlyNumberBelowOne) {
  RandomStream random(1, RandomUse::kGoal);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(random.Index(1), 0u);
}

TEST(RandomStream, ChoosesDifferentOnesEachAsOften) {
  constexpr int kCount = 5, kDrawn = 2, kTimes = 10'000;
  RandomStream random(1, RandomUse::kCountedEdges);
  std::array<int, kCount> chosen = {};
  for (int i = 0; i < kTimes; ++i) {
    const std::vector<int> two = random.Choose(kCount, kDrawn);
    ASSERT_EQ(two.size(), 2u);
    ASSERT_NE(two[0], two[1]);
    for (const int one : two) ++chosen.at(one);
  }
  // The tolerance is five standard deviations of a binomial count.
  for (const int count : chosen) EXPECT_NEAR(count, 0.4 * kTimes, 5 * std::sqrt(kTimes * 0.24));
  std::vector<int> all = random.Choose(kCount, kCount);
  std::ranges::sort(all);
  EXPECT_EQ(all, std::vector<int>({0, 1, 2, 3, 4}));
  EXPECT_TRUE(random.Choose(kCount, 0).empty());
}

}  // namespace random_test
}  // namespace regrasp
