#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <stdexcept>

#include "render/picture/animation.h"

namespace regrasp::render {
namespace color_table_test {

std::array<int, 3> Channels(Color color) { return {color.r, color.g, color.b}; }

std::set<std::array<int, 3>> AsSet(const std::vector<Color>& colors) {
  std::set<std::array<int, 3>> set;
  for (const Color& color : colors) set.insert(Channels(color));
  return set;
}

void SetPixel(Image& image, int at, Color color) {
  image.rgb[3 * at] = color.r;
  image.rgb[3 * at + 1] = color.g;
  image.rgb[3 * at + 2] = color.b;
}

Image MakeNoise(unsigned seed) {
  Image image = MakeImage(40, 30);
  std::mt19937 random(seed);
  for (unsigned char& channel : image.rgb) channel = static_cast<unsigned char>(random() % 256);
  return image;
}

TEST(ColorTableTest, AsFewColoursAsThereAreAreAllExact) {
  std::vector<Image> images = {MakeImage(8, 8, 255), MakeImage(8, 8, 20)};
  SetPixel(images[0], 3, {240, 176, 0});
  SetPixel(images[1], 5, {0, 101, 165});
  const std::set<std::array<int, 3>> all = {
      {255, 255, 255}, {20, 20, 20}, {240, 176, 0}, {0, 101, 165}};
  EXPECT_EQ(AsSet(ChooseColors(images, 4)), all);
  EXPECT_EQ(AsSet(ChooseColors(images, 255)), all);
  EXPECT_EQ(ChooseColors(images, 3).size(), 3u);
}

TEST(ColorTableTest, AThinLineKeepsItsColourBesideALargeBackgroundOfManyShades) {
  Image image = MakeImage(400, 300);
  for (int i = 0; i < 400 * 299; ++i) {
    const auto shade = static_cast<unsigned char>(180 + i % 60);
    SetPixel(image, i, {shade, shade, static_cast<unsigned char>(shade + i % 7)});
  }
  for (int i = 400 * 299; i < 400 * 300; ++i) SetPixel(image, i, {214, 16, 32});
  EXPECT_TRUE(AsSet(ChooseColors({&image, 1}, 16)).contains({214, 16, 32}));
}

TEST(ColorTableTest, MoreColoursAreNearerAndEveryCallChoosesTheSame) {
  const std::vector<Image> images = {MakeNoise(1), MakeNoise(2)};
  const auto error = [&](int count) {
    ColorTable table(ChooseColors(images, count));
    double sum = 0;
    for (int i = 0; i < 40 * 30; ++i) {
      const unsigned char* rgb = images[0].rgb.data() + 3 * i;
      const Color near = table.colors()[table.Nearest({rgb[0], rgb[1], rgb[2]})];
      for (int c = 0; c < 3; ++c) sum += std::abs(Channels(near)[c] - rgb[c]);
    }
    return sum;
  };
  EXPECT_LT(error(64), 0.8 * error(8));
  EXPECT_LT(error(255), 0.8 * error(64));
  EXPECT_EQ(AsSet(ChooseColors(images, 100)), AsSet(ChooseColors(images, 100)));
}

TEST(ColorTableTest, FindsTheNearestColour) {
  std::mt19937 random(7);
  std::vector<Color> colors;
  const auto draw = [&] { return static_cast<unsigned char>(random() % 256); };
  for (int i = 0; i < 200; ++i) colors.push_back({draw(), draw(), draw()});
  ColorTable table(colors);
  for (int i = 0; i < 500; ++i) {
    const Color color = {draw(), draw(), draw()};
    const auto distance = [&](Color other) {
      int sum = 0;
      for (int c = 0; c < 3; ++c) {
        const int along = Channels(other)[c] - Channels(color)[c];
        sum += along * along;
      }
      return sum;
    };
    const int least = distance(*std::ranges::min_element(colors, {}, distance));
    // The second call uses the stored result.
    EXPECT_EQ(distance(colors[table.Nearest(color)]), least);
    EXPECT_EQ(distance(colors[table.Nearest(color)]), least);
  }
}

TEST(ColorTableTest, NothingToChooseFromIsRefused) {
  EXPECT_THROW(static_cast<void>(ChooseColors({}, 4)), std::invalid_argument);
  const Image image = MakeImage(2, 2);
  EXPECT_THROW(static_cast<void>(ChooseColors({&image, 1}, 0)), std::invalid_argument);
}

}  // namespace color_table_test
}  // namespace regrasp::render
