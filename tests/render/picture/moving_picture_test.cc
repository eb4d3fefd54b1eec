#include "render/picture/moving_picture.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace regrasp::render {
namespace moving_picture_test {

constexpr MovingFormat kFormats[] = {MovingFormat::kMp4, MovingFormat::kGif, MovingFormat::kWebp};

TEST(MovingPictureTest, TheEndingOfTheNameSaysTheFormat) {
  EXPECT_EQ(MovingFormatOf("a/film.mp4"), MovingFormat::kMp4);
  EXPECT_EQ(MovingFormatOf("film.gif"), MovingFormat::kGif);
  EXPECT_EQ(MovingFormatOf("a.mp4.webp"), MovingFormat::kWebp);
  for (const char* other : {"film.avi", "film", "mp4", ".gif", "film.mp4/", "film.MP4", "-", ""}) {
    EXPECT_FALSE(MovingFormatOf(other)) << other;
  }
}

TEST(MovingPictureTest, EveryFormatIsWrittenAsItself) {
  const Image image = MakeImage(64, 48, 200);
  const auto file = [&](MovingFormat format) {
    const auto moving = MakeMovingPicture(format, 64, 48, {&image, 1});
    moving->Add(image, 2 * kTick_ms);
    return moving->Finish();
  };
  EXPECT_EQ(file(MovingFormat::kMp4).substr(4, 4), "ftyp");
  EXPECT_EQ(file(MovingFormat::kGif).substr(0, 6), "GIF89a");
  EXPECT_EQ(file(MovingFormat::kWebp).substr(8, 4), "WEBP");
  for (const MovingFormat format : kFormats) EXPECT_EQ(file(format), file(format));
}

TEST(MovingPictureTest, WhatCannotBeShownIsRefused) {
  const Image image = MakeImage(64, 48, 200);
  for (const MovingFormat format : kFormats) {
    EXPECT_THROW(static_cast<void>(MakeMovingPicture(format, 0, 48, {&image, 1})),
                 std::invalid_argument);
    EXPECT_THROW(static_cast<void>(MakeMovingPicture(format, 64, 1 << 20, {&image, 1})),
                 std::invalid_argument);
    const auto moving = MakeMovingPicture(format, 64, 48, {&image, 1});
    EXPECT_THROW(moving->Add(MakeImage(48, 64), kTick_ms), std::invalid_argument);
    EXPECT_THROW(moving->Add(image, 0), std::invalid_argument);
    moving->Add(image, kTick_ms);
    EXPECT_FALSE(moving->Finish().empty());
  }
}

TEST(MovingPictureTest, AGifNeedsExamplesOfItsColours) {
  EXPECT_THROW(static_cast<void>(MakeMovingPicture(MovingFormat::kGif, 64, 48, {})),
               std::invalid_argument);
  EXPECT_NE(MakeMovingPicture(MovingFormat::kMp4, 64, 48, {}), nullptr);
}

TEST(MovingPictureTest, OneThatIsLeftUnfinishedIsNoHarm) {
  const Image image = MakeImage(64, 48, 200);
  for (const MovingFormat format : kFormats) {
    const auto moving = MakeMovingPicture(format, 64, 48, {&image, 1});
    moving->Add(image, kTick_ms);
  }
}

}  // namespace moving_picture_test
}  // namespace regrasp::render
