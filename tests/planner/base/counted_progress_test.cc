#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/base/in_blocks.h"

namespace regrasp {
namespace counted_progress_test {

std::vector<std::string> ToldOf(int total, int done) {
  std::vector<std::string> told;
  const Tell tell = [&](std::string_view text) { told.emplace_back(text); };
  CountedProgress progress(tell, "joining", total);
  for (int i = 0; i < done; ++i) progress.Add();
  return told;
}

TEST(CountedProgress, TellsOfEveryPieceOfLittleWork) {
  EXPECT_EQ(ToldOf(2, 2),
            (std::vector<std::string>{"joining: 0 of 2", "joining: 1 of 2", "joining: 2 of 2"}));
  EXPECT_EQ(ToldOf(0, 0), std::vector<std::string>{"joining: 0 of 0"});
}

TEST(CountedProgress, TellsSomeHundredTimesOfWorkOfAnySize) {
  for (const int total : {99, 100, 101, 12345, 1'000'000}) {
    const auto told = ToldOf(total, total);
    EXPECT_GE(told.size(), 51u) << total;
    EXPECT_LE(told.size(), 101u) << total;
  }
  EXPECT_EQ(ToldOf(5000, 50).back(), "joining: 50 of 5000");
}

TEST(CountedProgress, MayGoOnFartherThanItSaidAndTellNobody) {
  EXPECT_EQ(ToldOf(1, 2).back(), "joining: 2 of 1");
  const Tell nobody;
  CountedProgress progress(nobody, "joining", 3);
  progress.Reach(3);
}

}  // namespace counted_progress_test
}  // namespace regrasp
