#include "render/picture/animation.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace regrasp::render {
namespace animation_test {

constexpr AnimationFormat kFormats[] = {AnimationFormat::kMp4, AnimationFormat::kGif,
                                        AnimationFormat::kWebp};

TEST(AnimationTest, TheExtensionDeterminesTheFormat) {
  EXPECT_EQ(FindAnimationFormat("a/film.mp4"), AnimationFormat::kMp4);
  EXPECT_EQ(FindAnimationFormat("film.gif"), AnimationFormat::kGif);
  EXPECT_EQ(FindAnimationFormat("a.mp4.webp"), AnimationFormat::kWebp);
  EXPECT_EQ(FindAnimationFormat("film.MP4"), AnimationFormat::kMp4);
  for (const char* other : {"film.avi", "film", "mp4", ".gif", "film.mp4/", "-", ""}) {
    EXPECT_FALSE(FindAnimationFormat(other)) << other;
  }
}

TEST(AnimationTest, EveryFormatIsWrittenAsItself) {
  const Image image = MakeImage(64, 48, 200);
  const auto file = [&](AnimationFormat format) {
    const auto moving = MakeAnimation(format, 64, 48, {&image, 1});
    moving->Add(image, 2);
    return moving->Finish();
  };
  EXPECT_EQ(file(AnimationFormat::kMp4).substr(4, 4), "ftyp");
  EXPECT_EQ(file(AnimationFormat::kGif).substr(0, 6), "GIF89a");
  EXPECT_EQ(file(AnimationFormat::kWebp).substr(8, 4), "WEBP");
  for (const AnimationFormat format : kFormats) EXPECT_EQ(file(format), file(format));
}

TEST(AnimationTest, InvalidImagesAreRefused) {
  const Image image = MakeImage(64, 48, 200);
  for (const AnimationFormat format : kFormats) {
    EXPECT_THROW(static_cast<void>(MakeAnimation(format, 0, 48, {&image, 1})),
                 std::invalid_argument);
    EXPECT_THROW(static_cast<void>(MakeAnimation(format, 64, 1 << 20, {&image, 1})),
                 std::invalid_argument);
    const auto moving = MakeAnimation(format, 64, 48, {&image, 1});
    EXPECT_THROW(moving->Add(MakeImage(48, 64), 1), std::invalid_argument);
    EXPECT_THROW(moving->Add(image, 0), std::invalid_argument);
    moving->Add(image, 1);
    EXPECT_FALSE(moving->Finish().empty());
  }
}

TEST(AnimationTest, AGifNeedsExamplesOfItsColours) {
  EXPECT_THROW(static_cast<void>(MakeAnimation(AnimationFormat::kGif, 64, 48, {})),
               std::invalid_argument);
  EXPECT_NE(MakeAnimation(AnimationFormat::kMp4, 64, 48, {}), nullptr);
}

}  // namespace animation_test
}  // namespace regrasp::render
