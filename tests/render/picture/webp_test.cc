#include <gtest/gtest.h>
#include <webp/decode.h>
#include <webp/demux.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

#include "render/picture/animation.h"

namespace regrasp::render {
namespace webp_test {

const std::uint8_t* Bytes(const std::string& text) {
  return reinterpret_cast<const std::uint8_t*>(text.data());
}

Image MakeFlat(int width, int height, unsigned char brightness) {
  return MakeImage(width, height, brightness);
}

TEST(WebpTest, DecodingReturnsTheEncodedImage) {
  Image image = MakeFlat(64, 48, 255);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 32; ++x) image.rgb[3 * (64 * y + x)] = 40;  // the left half is cyan
  }
  const std::string webp = EncodeWebp(image, 64);
  int width = 0, height = 0;
  const std::unique_ptr<std::uint8_t, void (*)(void*)> decoded(
      WebPDecodeRGB(Bytes(webp), webp.size(), &width, &height), &WebPFree);
  ASSERT_NE(decoded, nullptr);
  ASSERT_EQ(width, 64);
  ASSERT_EQ(height, 48);
  int near = 0;
  for (int i = 0; i < 3 * 64 * 48; ++i) near += std::abs(decoded.get()[i] - image.rgb[i]) < 24;
  EXPECT_GT(near, 3 * 64 * 48 * 9 / 10);
  EXPECT_EQ(webp, EncodeWebp(image, 64));
}

TEST(WebpTest, WideImagesAreScaledDownAndNarrowOnesAreNot) {
  const auto size_of = [](const std::string& webp) {
    int width = 0, height = 0;
    EXPECT_NE(WebPGetInfo(Bytes(webp), webp.size(), &width, &height), 0);
    return std::pair(width, height);
  };
  EXPECT_EQ(size_of(EncodeWebp(MakeFlat(1280, 960, 90), 320)), std::pair(320, 240));
  EXPECT_EQ(size_of(EncodeWebp(MakeFlat(100, 60, 90), 320)), std::pair(100, 60));
  EXPECT_EQ(size_of(EncodeWebp(MakeFlat(4000, 1, 90), 10)), std::pair(10, 1));
}

TEST(WebpTest, UnsupportedSizesAreRefused) {
  EXPECT_THROW(static_cast<void>(EncodeWebp({}, 10)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(EncodeWebp(MakeFlat(16384, 1, 0), 10)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(EncodeWebp(MakeFlat(4, 4, 0), 0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(MakeWebpAnimation(0, 4)), std::invalid_argument);
}

TEST(WebpAnimationTest, EveryImageIsShownForItsTime) {
  const auto animation = MakeWebpAnimation(32, 24);
  animation->Add(MakeFlat(32, 24, 20), 3);
  animation->Add(MakeFlat(32, 24, 220), 27);
  const std::string webp = animation->Finish();
  const WebPData data = {Bytes(webp), webp.size()};
  const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> decoder(
      WebPAnimDecoderNew(&data, nullptr), &WebPAnimDecoderDelete);
  ASSERT_NE(decoder, nullptr);
  std::vector<int> ends, brightness;
  while (WebPAnimDecoderHasMoreFrames(decoder.get()) != 0) {
    std::uint8_t* rgba = nullptr;
    int end = 0;
    ASSERT_NE(WebPAnimDecoderGetNext(decoder.get(), &rgba, &end), 0);
    ends.push_back(end);
    brightness.push_back(rgba[0]);
  }
  EXPECT_EQ(ends, (std::vector<int>{100, 1000}));
  ASSERT_EQ(brightness.size(), 2u);
  EXPECT_NEAR(brightness[0], 20, 4);
  EXPECT_NEAR(brightness[1], 220, 4);
}

/// Images with small changes, such as shading, and a large change in one corner.
TEST(WebpAnimationTest, SlowChangesReachTheirFinalValue) {
  constexpr int kSide = 64;
  const auto animation = MakeWebpAnimation(kSide, kSide);
  constexpr int kImages = 60;
  for (int i = 0; i < kImages; ++i) {
    Image image = MakeFlat(kSide, kSide, static_cast<unsigned char>(80 + i));
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) image.rgb[3 * (kSide * y + x)] = i % 2 == 0 ? 0 : 255;
    }
    animation->Add(image, 1);
  }
  const std::string webp = animation->Finish();
  const WebPData data = {Bytes(webp), webp.size()};
  const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> decoder(
      WebPAnimDecoderNew(&data, nullptr), &WebPAnimDecoderDelete);
  ASSERT_NE(decoder, nullptr);
  std::uint8_t* rgba = nullptr;
  int time = 0;
  int shown = 0;
  int worst = 0;
  while (WebPAnimDecoderGetNext(decoder.get(), &rgba, &time) != 0) {
    const int should = 80 + (time - 1) * kFramesPerSecond / 1000;
    for (int i = kSide * kSide / 2; i < kSide * kSide; ++i) {
      worst = std::max(worst, std::abs(rgba[4 * i] - should));
    }
    ++shown;
  }
  EXPECT_GT(shown, kImages / 2);
  EXPECT_LE(worst, 16) << "59 without key frames";
}

TEST(WebpAnimationTest, ImagesOfAnotherSizeAreRefused) {
  const auto animation = MakeWebpAnimation(32, 24);
  EXPECT_THROW(animation->Add(MakeFlat(24, 32, 0), 1), std::invalid_argument);
  EXPECT_THROW(animation->Add(MakeFlat(32, 24, 0), 0), std::invalid_argument);
}

}  // namespace webp_test
}  // namespace regrasp::render
