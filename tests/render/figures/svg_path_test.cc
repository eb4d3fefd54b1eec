#include "render/figures/svg_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace regrasp::render {
namespace svg_path_test {

TEST(ShortPathDataTest, CoordinatesAreRelativeAndRounded) {
  EXPECT_EQ(ShortPathData("M 0.375 1.328125 L 0.375 -5.28125 L 4.125 -5.28125 Z M 1 1 "),
            "m.38 1.33 0-6.61 3.75 0zm.62-.33");
  EXPECT_EQ(ShortPathData("M 10 20 C 11 20 12 21 12.5 22 C 13 23 13 24 13 25 L 0 0"),
            "m10 20c1 0 2 1 2.5 2 .5 1 .5 2 .5 3l-13-25");
  EXPECT_EQ(ShortPathData("M 1.05 -0.5 L 1.1 0"), "m1.05-.5 .05 .5");
  EXPECT_EQ(ShortPathData(""), "");
}

TEST(ShortPathDataTest, OtherDataAreUnchanged) {
  for (const char* data : {"M 1 2 A 3 4 0 1 0 5 6", "L 1 2", "M 1", "M 1 2 L 3", "M 1 2 Z 3 4",
                           "M 1 2 l 3 4", "M 1 nan", "1 2", "M 1e300 0"}) {
    EXPECT_EQ(ShortPathData(data), data);
  }
}

TEST(ShortPathDataTest, RoundingErrorsDoNotAddUp) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-200, 200);
  std::ostringstream data;
  std::vector<double> expected;
  for (int i = 0; i < 1000; ++i) {
    data << (i == 0 ? "M " : " L ");
    for (int axis = 0; axis < 2; ++axis) {
      expected.push_back(std::round(1e6 * place(random)) / 1e6);
      data << std::to_string(expected.back()) << (axis == 0 ? " " : "");
    }
  }
  std::string text = ShortPathData(data.str());
  ASSERT_EQ(text.front(), 'm');
  EXPECT_LT(text.size(), data.str().size() * 2 / 3);
  std::string spaced;
  for (const char c : text.substr(1)) {
    if (c == '-') spaced += ' ';
    spaced += c;
  }
  std::istringstream numbers(spaced);
  double now[2] = {0, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    double step = 0;
    ASSERT_TRUE(numbers >> step) << i;
    now[i % 2] += step;
    EXPECT_NEAR(now[i % 2], expected[i], 0.0051) << i;
  }
}

TEST(ShortenPathsTest, OnlyDataOfPathsChange) {
  EXPECT_EQ(ShortenPaths("<g id=\"M 1.00 2.00\"><path style=\"fill:none;\" d=\"M 1.00 2.00 L 2 2 "
                         "\"/>M 1.00 2.00<path/></g>"),
            "<g id=\"M 1.00 2.00\"><path style=\"fill:none;\" d=\"m1 2 1 0\"/>M 1.00 "
            "2.00<path/></g>");
  EXPECT_EQ(ShortenPaths("<path d=\"M 1"), "<path d=\"M 1");
}

}  // namespace svg_path_test
}  // namespace regrasp::render
