#include "render/picture/image.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>

#include "planner/base/error.h"

namespace regrasp::render {
namespace image_test {

Image MakeNoise(int width, int height) {
  std::mt19937 random(7);
  Image image = MakeImage(width, height);
  for (unsigned char& byte : image.rgb) byte = static_cast<unsigned char>(random() % 256);
  return image;
}

std::filesystem::path TestFile(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

TEST(ImageTest, PngDecodesToTheSameImage) {
  const Image image = MakeNoise(37, 21);
  const std::filesystem::path path = TestFile("regrasp_image_test.png");
  WritePng(path, image);
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&header, path.c_str()), 0) << header.message;
  header.format = PNG_FORMAT_RGB;
  ASSERT_EQ(header.width, 37U);
  ASSERT_EQ(header.height, 21U);
  std::vector<unsigned char> rgb(PNG_IMAGE_SIZE(header));
  ASSERT_NE(png_image_finish_read(&header, nullptr, rgb.data(), 0, nullptr), 0) << header.message;
  EXPECT_EQ(rgb, image.rgb);
  std::filesystem::remove(path);
}

TEST(ImageTest, AnImageWithFewColoursIsAboutAsSmallAsWithLibpng) {
  Image image = MakeImage(640, 480);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double away = std::hypot(x - 300, y - 200);
      if (away > 150) continue;
      for (int i = 0; i < 3; ++i) {
        image.rgb[3 * (640 * y + x) + i] = static_cast<unsigned char>(250 - (1 + i) * away / 3);
      }
    }
  }
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = 640;
  header.height = 480;
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t usual = 0;
  ASSERT_NE(png_image_write_to_memory(&header, nullptr, &usual, 0, image.rgb.data(), 0, nullptr),
            0);
  EXPECT_LT(EncodePng(image).size(), 1.3 * static_cast<double>(usual));
}

TEST(ImageTest, TransparencyComesFromTheSameDrawingOnWhiteAndOnBlack) {
  // Left: half of the colour (200, 100, 0). Right: opaque.
  Image white = MakeImage(3, 1);
  white.rgb = {227, 177, 127, 10, 20, 30, 255, 255, 255};
  Image black = MakeImage(3, 1);
  black.rgb = {100, 50, 0, 10, 20, 30, 0, 0, 0};
  const Image image = MakeTransparent(white, black);
  EXPECT_EQ(image.alpha, (std::vector<unsigned char>{128, 255, 0}));
  const std::string bytes = EncodePng(image);
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(header.format, PNG_FORMAT_RGBA);
  std::vector<unsigned char> rgba(PNG_IMAGE_SIZE(header));
  ASSERT_NE(png_image_finish_read(&header, nullptr, rgba.data(), 0, nullptr), 0);
  EXPECT_NEAR(rgba[0], 200, 2);
  EXPECT_NEAR(rgba[1], 100, 2);
  EXPECT_NEAR(rgba[2], 0, 2);
  EXPECT_EQ(rgba[3], 128);
  EXPECT_EQ((std::vector<unsigned char>(rgba.begin() + 4, rgba.end())),
            (std::vector<unsigned char>{10, 20, 30, 255, 0, 0, 0, 0}));
  EXPECT_THROW(MakeTransparent(white, MakeImage(1, 3)), std::invalid_argument);
}

TEST(ImageTest, CannotBeWrittenIntoAFolderThatIsNotThere) {
  EXPECT_THROW(WritePng(TestFile("regrasp_no_such_folder/image.png"), MakeImage(8, 8)),
               EnvironmentError);
}

TEST(ImageTest, ShrinksByAveragingBlocks) {
  Image image = MakeImage(4, 2, 0);
  image.rgb[0] = 255;   // red of the first block's first pixel
  image.rgb[22] = 100;  // green of the second block's last pixel
  const Image small = Shrink(image, 2);
  EXPECT_EQ(small.width, 2);
  EXPECT_EQ(small.height, 1);
  EXPECT_EQ(small.rgb, (std::vector<unsigned char>{64, 0, 0, 0, 25, 0}));
}

TEST(ImageTest, ShrinkingByOneChangesNothingAndAnUnevenFactorIsRefused) {
  const Image image = MakeNoise(6, 4);
  EXPECT_EQ(Shrink(image, 1).rgb, image.rgb);
  EXPECT_THROW((void)Shrink(image, 4), std::invalid_argument);
}

}  // namespace image_test
}  // namespace regrasp::render
