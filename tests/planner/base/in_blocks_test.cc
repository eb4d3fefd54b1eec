#include "planner/base/in_blocks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace regrasp {
namespace in_blocks_test {

TEST(InBlocksTest, EveryIndexIsWorkedOnOnceWhateverTheThreads) {
  for (const int threads : {0, 1, 2, 7}) {
    for (const std::size_t count : {0, 1, 9, 10, 11, 1000}) {
      std::vector<std::atomic<int>> times(count);
      InBlocks(count, 10, threads, [&](std::size_t begin, std::size_t end) {
        EXPECT_LE(end - begin, 10U);
        EXPECT_EQ(begin % 10, 0U);
        for (std::size_t i = begin; i < end; ++i) ++times[i];
      });
      for (const auto& n : times) EXPECT_EQ(n, 1);
    }
  }
}

TEST(InBlocksTest, TheFirstBlockThatFailsIsTold) {
  for (const int threads : {1, 4}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      try {
        InBlocks(1000, 10, threads, [](std::size_t begin, std::size_t) {
          if (begin >= 70) throw std::runtime_error(std::to_string(begin));
        });
        FAIL();
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "70");
      }
    }
  }
}

TEST(InBlocksTest, FewerThanNoThreadsAreRefused) {
  EXPECT_THROW(InBlocks(1, 1, -1, [](std::size_t, std::size_t) {}), std::invalid_argument);
}

}  // namespace in_blocks_test
}  // namespace regrasp
