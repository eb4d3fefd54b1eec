#include "render/frames/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace regrasp::render {
namespace contact_sheet_test {

/// How many pixels have this colour.
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

TEST(ContactSheetTest, EveryPictureHasItsPlaceInTheGrid) {
  ContactSheet sheet(5, 640, 480);
  const Image empty = sheet.ToImage();
  EXPECT_EQ(Count(empty, 255, 255, 255), empty.width * empty.height);
  for (int i = 0; i < 5; ++i) sheet.Add(MakeFlat(640, 480, 50 + 10 * i), {"", "", kInk});
  const Image image = sheet.ToImage();
  EXPECT_GT(image.width, image.height);  // three columns, two rows
  for (int i = 0; i < 5; ++i) {
    EXPECT_GE(Count(image, 50 + 10 * i, 10, 10), 490 * 367) << i;  // without their borders
  }
}

TEST(ContactSheetTest, LabelsAreWrittenInTheirColour) {
  ContactSheet plain(1, 320, 240), labelled(1, 320, 240);
  const Color red = {179, 38, 30};
  plain.Add(MakeImage(320, 240, 255), {});
  labelled.Add(MakeImage(320, 240, 255), {"3  switch", "slipped", red});
  EXPECT_EQ(Count(plain.ToImage(), red.r, red.g, red.b), 0);
  EXPECT_GT(Count(labelled.ToImage(), red.r, red.g, red.b), 20);
  EXPECT_GT(Count(labelled.ToImage(), kInk.r, kInk.g, kInk.b), 20);
}

TEST(ContactSheetTest, AFailureIsFramedAndWhatComesAfterItIsGrey) {
  const Color red = {179, 38, 30};
  const auto draw = [&](bool failed) {
    ContactSheet sheet(2, 320, 240);
    sheet.Add(MakeImage(320, 240, 255), {"", "", red, failed});
    if (failed) sheet.AddEmpty({"", "", kInk}, "not replayed");
    return sheet.ToImage();
  };
  EXPECT_EQ(Count(draw(false), red.r, red.g, red.b), 0);
  EXPECT_GT(Count(draw(true), red.r, red.g, red.b), 2 * 2 * (320 + 240));
  EXPECT_GT(Count(draw(true), 238, 240, 244), 320 * 240 * 9 / 10);
}

TEST(ContactSheetTest, TheHeadingStandsAboveAllPictures) {
  const Color green = {29, 107, 60};
  const Image plain = ContactSheet(4, 320, 240).ToImage();
  const Image headed = ContactSheet(4, 320, 240, kSheetWidth, {"PASS", "", green}).ToImage();
  EXPECT_EQ(headed.width, plain.width);
  EXPECT_GT(headed.height, plain.height);
  EXPECT_GT(Count(headed, green.r, green.g, green.b), 20);
  // However long, it is not cut off: no ink at the right border.
  const Image longer =
      ContactSheet(1, 320, 240, kSheetWidth, {std::string(300, 'm'), "", kInk}).ToImage();
  for (int y = 0; y < longer.height; ++y) {
    EXPECT_EQ(longer.rgb[3 * (std::size_t(y + 1) * longer.width - 1)], 255);
  }
}

TEST(ContactSheetTest, ManyPicturesAreSmallSoThatTheSheetCanBeOpened) {
  const Image image = ContactSheet(1000, 1280, 960).ToImage();
  EXPECT_LE(image.width, kSheetWidth);
  EXPECT_LE(image.height, 12'000);
  // Cairo's limit is 32767 pixels.
  const SheetGrid most(20'000, 1280, 960, kSheetWidth);
  EXPECT_LE(most.sheet_height(), 12'000);
  EXPECT_LT(most.sheet_width(), 20'000);
}

TEST(ContactSheetTest, TheSheetIsAsWideAsAskedAndItsLabelsAreAsLarge) {
  for (const int width : {400, 1600, 3200}) {
    for (const int count : {1, 4, 9, 30}) {
      const SheetGrid grid(count, 6400, 4800, width);
      EXPECT_LE(grid.sheet_width(), width);
      EXPECT_GT(grid.sheet_width(), 0.9 * width) << width << " " << count;
      EXPECT_GE(grid.font, 11);
    }
  }
  EXPECT_EQ(SheetGrid(1, 640, 480, 1600).width, 640);  // not enlarged
  // Long pictures stand in fewer columns.
  EXPECT_EQ(SheetGrid(4, 1280, 320, 1600).columns, 2);
  EXPECT_EQ(SheetGrid(9, 1280, 320, 1600).columns, 2);
  EXPECT_EQ(SheetGrid(9, 1280, 960, 1600).columns, 3);
  // Two by two, and no empty cells beside them.
  EXPECT_EQ(SheetGrid(4, 1100, 960, 1600).columns, 2);
  EXPECT_EQ(SheetGrid(6, 1280, 960, 1600).columns, 3);
  EXPECT_EQ(SheetGrid(8, 1280, 960, 1600).columns, 3);
}

TEST(ContactSheetTest, OnADarkGroundThereIsNoWhite) {
  ContactSheet sheet(1, 320, 240, kSheetWidth, {"PASS", "", {29, 200, 60}}, kDarkGround);
  sheet.Add(MakeFlat(320, 240, 50), {"1  switch", "pass", {29, 200, 60}});
  const Image image = sheet.ToImage();
  EXPECT_EQ(Count(image, 255, 255, 255), 0);
  const Color paper = kDarkGround.paper;
  EXPECT_GT(Count(image, paper.r, paper.g, paper.b), 320 * 20);
}

TEST(ContactSheetTest, PicturesThatWereNotAnnouncedAreRefused) {
  EXPECT_THROW(ContactSheet(0, 10, 10), std::invalid_argument);
  EXPECT_THROW(ContactSheet(1, 0, 10), std::invalid_argument);
  ContactSheet sheet(1, 64, 48);
  EXPECT_THROW(sheet.Add(MakeImage(48, 64), {}), std::invalid_argument);
  sheet.Add(MakeImage(64, 48), {});
  EXPECT_THROW(sheet.Add(MakeImage(64, 48), {}), std::invalid_argument);
}

}  // namespace contact_sheet_test
}  // namespace regrasp::render
