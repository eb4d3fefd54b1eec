#include "apps/nearest_word.h"

#include <gtest/gtest.h>

namespace regrasp::apps {
namespace nearest_word_test {

const std::vector<std::string> kWords = {"--object", "--output", "--friction-angle", "--mu"};

TEST(DidYouMean, NamesTheWordThatFewEditsMake) {
  for (const char* given : {"--objct", "--obejct", "--objects", "--obiect"}) {
    EXPECT_EQ(DidYouMean(given, kWords), "; did you mean --object?") << given;
  }
}

TEST(DidYouMean, NamesTheWordThatWasBegun) {
  EXPECT_EQ(DidYouMean("--fric", kWords), "; did you mean --friction-angle?");
}

TEST(DidYouMean, SaysNothingWhereNoWordIsNear) {
  EXPECT_EQ(DidYouMean("--verbose", kWords), "");
  EXPECT_EQ(DidYouMean("", kWords), "");
  EXPECT_EQ(DidYouMean("--object", {}), "");
  EXPECT_EQ(DidYouMean("--object" + std::string(100, 't'), kWords), "");
}

}  // namespace nearest_word_test
}  // namespace regrasp::apps
