#include <gtest/gtest.h>
#include <png.h>

#include <string>
#include <vector>

#include "render/figures/figure_page.h"

namespace regrasp::render {
namespace figure_mark_test {

constexpr FigureFormat kFormats[] = {FigureFormat::kSvg, FigureFormat::kPdf, FigureFormat::kPng};

TEST(FigureMarkTest, EveryFormatNamesItsProgram) {
  for (const FigureFormat format : kFormats) {
    std::string bytes = FigurePage(format, 20, 10).Finish();
    EXPECT_TRUE(IsMarkedFigure(bytes));
    bytes.replace(bytes.find(kFigureMaker), 1, "R");
    EXPECT_FALSE(IsMarkedFigure(bytes));
  }
}

TEST(FigureMarkTest, AFileThatOnlyMentionsTheMakerIsNotMarked) {
  EXPECT_FALSE(IsMarkedFigure(""));
  EXPECT_FALSE(IsMarkedFigure("<!-- Creator: regrasp figure -->\n"));
  EXPECT_FALSE(IsMarkedFigure("<?xml version=\"1.0\"?>\n<svg><text>regrasp figure</text></svg>\n"));
}

TEST(FigureMarkTest, AMarkedPngIsStillReadWithoutAComplaint) {
  const std::string bytes = FigurePage(FigureFormat::kPng, 20, 10).Finish();
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
  image.format = PNG_FORMAT_RGB;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
  EXPECT_EQ(image.warning_or_error, 0u) << image.message;
}

}  // namespace figure_mark_test
}  // namespace regrasp::render
