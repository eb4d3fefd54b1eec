#include "apps/options.h"

#include <gtest/gtest.h>

namespace regrasp::apps {
namespace nearest_word_test {

const std::vector<std::string> kWords = {"--object", "--output", "--friction-angle", "--mu"};

TEST(SimilarWord, NamesTheWordThatFewEditsMake) {
  for (const char* given : {"--objct", "--obejct", "--objects", "--obiect"}) {
    EXPECT_EQ(SimilarWord(given, kWords), "; similar: --object") << given;
  }
}

TEST(SimilarWord, NamesTheWordThatWasBegun) {
  EXPECT_EQ(SimilarWord("--fric", kWords), "; similar: --friction-angle");
}

TEST(SimilarWord, SaysNothingWhereNoWordIsNear) {
  EXPECT_EQ(SimilarWord("--verbose", kWords), "");
  EXPECT_EQ(SimilarWord("", kWords), "");
  EXPECT_EQ(SimilarWord("--object", {}), "");
  EXPECT_EQ(SimilarWord("--object" + std::string(100, 't'), kWords), "");
}

}  // namespace nearest_word_test
}  // namespace regrasp::apps
