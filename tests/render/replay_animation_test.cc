#include "render/replay_animation.h"

#include <gtest/gtest.h>

namespace regrasp {
namespace {

using Indices = std::vector<int>;

TEST(ReplayAnimationTest, InstantsAreSpreadEvenlyOverTheTimeOfAnEntry) {
  std::vector<double> times;
  for (int i = 0; i < 100; ++i) times.push_back(i);
  EXPECT_EQ(ChooseInstants(times, 9.5, 20, 5), (Indices{11, 13, 15, 17, 19}));
  // The end belongs to the entry, its beginning to the one before.
  EXPECT_EQ(ChooseInstants(times, 10, 12, 10), (Indices{12}));
  EXPECT_EQ(ChooseInstants(times, -1e9, 1e9, 2), (Indices{25, 75}));
}

TEST(ReplayAnimationTest, InstantsAreNotRepeated) {
  EXPECT_EQ(ChooseInstants({0, 1}, -1, 2, 50), (Indices{1}));
  EXPECT_EQ(ChooseInstants({1}, 0, 2, 3), (Indices{0}));
  EXPECT_TRUE(ChooseInstants({}, 0, 1, 3).empty());
  EXPECT_TRUE(ChooseInstants({1, 2}, 2, 5, 3).empty());
}

}  // namespace
}  // namespace regrasp
