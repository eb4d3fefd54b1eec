#include "render/frames/overview_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace regrasp::render {
namespace overview_image_test {

/// Return the number of pixels with this colour.
int Count(const Image& image, unsigned char r, unsigned char g, unsigned char b) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    count += image.rgb[i] == r && image.rgb[i + 1] == g && image.rgb[i + 2] == b;
  }
  return count;
}

Image MakeFlat(int width, int height, unsigned char r) {
  Image image = MakeImage(width, height, 10);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) image.rgb[i] = r;
  return image;
}

TEST(OverviewImageTest, EveryImageHasItsCell) {
  OverviewImage sheet(5, 640, 480);
  const Image empty = sheet.ToImage();
  EXPECT_EQ(Count(empty, 255, 255, 255), empty.width * empty.height);
  for (int i = 0; i < 5; ++i) sheet.Add(MakeFlat(640, 480, 50 + 10 * i), {"", "", kInk});
  const Image image = sheet.ToImage();
  EXPECT_GT(image.width, image.height);  // three columns, two rows
  for (int i = 0; i < 5; ++i) {
    EXPECT_GE(Count(image, 50 + 10 * i, 10, 10), 490 * 367) << i;  // without their borders
  }
}

TEST(OverviewImageTest, LabelsAreWrittenInTheirColour) {
  OverviewImage plain(1, 320, 240), labelled(1, 320, 240);
  const Color red = {179, 38, 30};
  plain.Add(MakeImage(320, 240, 255), {});
  labelled.Add(MakeImage(320, 240, 255), {"3  switch", "slipped", red});
  EXPECT_EQ(Count(plain.ToImage(), red.r, red.g, red.b), 0);
  EXPECT_GT(Count(labelled.ToImage(), red.r, red.g, red.b), 20);
  EXPECT_GT(Count(labelled.ToImage(), kInk.r, kInk.g, kInk.b), 20);
}

TEST(OverviewImageTest, AFailureIsFramedAndLaterCellsAreGrey) {
  const Color red = {179, 38, 30};
  const auto draw = [&](bool failed) {
    OverviewImage sheet(2, 320, 240);
    sheet.Add(MakeImage(320, 240, 255), {"", "", red, failed});
    if (failed) sheet.AddEmpty({"", "", kInk}, "not replayed");
    return sheet.ToImage();
  };
  EXPECT_EQ(Count(draw(false), red.r, red.g, red.b), 0);
  EXPECT_GT(Count(draw(true), red.r, red.g, red.b), 2 * 2 * (320 + 240));
  EXPECT_GT(Count(draw(true), 238, 240, 244), 320 * 240 * 9 / 10);
}

/// Return the rows of an overview of one image that a note changes: the first and the last.
std::pair<int, int> RowsOfNote(const std::string& title) {
  const auto draw = [&](const std::string& note) {
    OverviewImage sheet(1, 640, 480);
    sheet.Add(MakeFlat(640, 480, 200), {title, "pass", kInk, false, note});
    return sheet.ToImage();
  };
  const Image plain = draw(""), marked = draw("smallest friction margin: 3.1°");
  std::vector<int> rows;
  for (std::size_t i = 0; i < plain.rgb.size(); i += 3) {
    if (plain.rgb[i] != marked.rgb[i]) rows.push_back(static_cast<int>(i / 3 / plain.width));
  }
  EXPECT_GT(rows.size(), 200U);
  return {rows.front(), rows.back()};
}

TEST(OverviewImageTest, ANoteIsInTheLabelIfItFits) {
  const OverviewGrid grid(1, 640, 480, kOverviewWidth);
  EXPECT_LT(RowsOfNote("1  align").second, grid.y(0) + grid.label);
}

TEST(OverviewImageTest, ANoteNextToALongLabelIsAtTheTopOfItsImage) {
  const OverviewGrid grid(1, 640, 480, kOverviewWidth);
  const auto [first, last] = RowsOfNote("12  switch · 36.7° of 90° about the vertical axis");
  EXPECT_GE(first, grid.y(0) + grid.label);
  EXPECT_LT(last, grid.y(0) + grid.label + grid.height / 4);
}

TEST(OverviewImageTest, TheHeadingIsAboveAllImages) {
  const Color green = {29, 107, 60};
  const Image plain = OverviewImage(4, 320, 240).ToImage();
  const Image headed = OverviewImage(4, 320, 240, kOverviewWidth, {"PASS", "", green}).ToImage();
  EXPECT_EQ(headed.width, plain.width);
  EXPECT_GT(headed.height, plain.height);
  EXPECT_GT(Count(headed, green.r, green.g, green.b), 20);
  // A long heading is not cut off: the right border has no ink.
  const Image longer =
      OverviewImage(1, 320, 240, kOverviewWidth, {std::string(300, 'm'), "", kInk}).ToImage();
  for (int y = 0; y < longer.height; ++y) {
    EXPECT_EQ(longer.rgb[3 * (std::size_t(y + 1) * longer.width - 1)], 255);
  }
}

TEST(OverviewImageTest, ManyImagesAreSmallSoThatTheOverviewFitsCairo) {
  const Image image = OverviewImage(1000, 1280, 960).ToImage();
  EXPECT_LE(image.width, kOverviewWidth);
  EXPECT_LE(image.height, 12'000);
  // Cairo's limit is 32767 pixels.
  const OverviewGrid most(20'000, 1280, 960, kOverviewWidth);
  EXPECT_LE(most.total_height(), 12'000);
  EXPECT_LT(most.total_width(), 20'000);
}

TEST(OverviewImageTest, TheOverviewHasTheRequestedWidthAndLabelSize) {
  for (const int width : {400, 1600, 3200}) {
    for (const int count : {1, 4, 9, 30}) {
      const OverviewGrid grid(count, 6400, 4800, width);
      EXPECT_LE(grid.total_width(), width);
      EXPECT_GT(grid.total_width(), 0.9 * width) << width << " " << count;
      EXPECT_GE(grid.font, 11);
    }
  }
  EXPECT_EQ(OverviewGrid(1, 640, 480, 1600).width, 640);  // not enlarged
  // Wide images have fewer columns.
  EXPECT_EQ(OverviewGrid(4, 1280, 320, 1600).columns, 2);
  EXPECT_EQ(OverviewGrid(9, 1280, 320, 1600).columns, 2);
  EXPECT_EQ(OverviewGrid(9, 1280, 960, 1600).columns, 3);
  // Two by two, without empty cells.
  EXPECT_EQ(OverviewGrid(4, 1100, 960, 1600).columns, 2);
  EXPECT_EQ(OverviewGrid(6, 1280, 960, 1600).columns, 3);
  EXPECT_EQ(OverviewGrid(8, 1280, 960, 1600).columns, 3);
}

TEST(OverviewImageTest, OnADarkGroundThereIsNoWhite) {
  OverviewImage sheet(1, 320, 240, kOverviewWidth, {"PASS", "", {29, 200, 60}}, kDarkGround);
  sheet.Add(MakeFlat(320, 240, 50), {"1  switch", "pass", {29, 200, 60}});
  const Image image = sheet.ToImage();
  EXPECT_EQ(Count(image, 255, 255, 255), 0);
  const Color paper = kDarkGround.paper;
  EXPECT_GT(Count(image, paper.r, paper.g, paper.b), 320 * 20);
}

TEST(OverviewImageTest, UnannouncedImagesAreRefused) {
  EXPECT_THROW(OverviewImage(0, 10, 10), std::invalid_argument);
  EXPECT_THROW(OverviewImage(1, 0, 10), std::invalid_argument);
  OverviewImage sheet(1, 64, 48);
  EXPECT_THROW(sheet.Add(MakeImage(48, 64), {}), std::invalid_argument);
  sheet.Add(MakeImage(64, 48), {});
  EXPECT_THROW(sheet.Add(MakeImage(64, 48), {}), std::invalid_argument);
}

TEST(OverviewImageTest, TextsInSmallImagesAreLarger) {
  const auto size = [](int count) { return OverviewImage(count, 1280, 960).TextSize(); };
  EXPECT_EQ(size(1), 1);
  EXPECT_GT(size(25), 1.5);
  EXPECT_LE(size(400), 2.5);
}

}  // namespace overview_image_test
}  // namespace regrasp::render
