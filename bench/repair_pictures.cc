// Draws files beside what their repair makes of them, in two columns of pairs: the original on the
// left, the solid on the right. What was invented is red, the inside of a surface yellow.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/surface_picture.h"
#include "planner/object/read_soup.h"
#include "planner/repair/repair.h"
#include "render/picture/cairo_image.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/image.h"

namespace {

using namespace regrasp;

constexpr int kBadUsage = 2;

// Pixels.
constexpr int kSide = 300;
constexpr int kGap = 10;
constexpr int kTitle = 30;
constexpr int kMargin = 15;
constexpr double kFontSize = 17;

constexpr int kColumns = 2;

struct Pair {
  std::filesystem::path file;
  SurfaceView view;
};

std::vector<Pair> PairsOf(const std::vector<std::string>& words) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i + 2 < words.size(); i += 3) {
    pairs.push_back({words[i], {std::stod(words[i + 1]), std::stod(words[i + 2])}});
  }
  return pairs;
}

void Paste(const render::Image& picture, int left, int top, render::Image& sheet) {
  for (int y = 0; y < picture.height; ++y) {
    std::copy_n(picture.rgb.begin() + std::ptrdiff_t{3} * y * picture.width, 3 * picture.width,
                sheet.rgb.begin() + std::ptrdiff_t{3} * ((top + y) * sheet.width + left));
  }
}

void PasteText(const std::string& text, int left, int bottom, render::Image& sheet) {
  const render::CairoImage image(sheet);
  render::SelectFont(image.context(), kFontSize, false);
  render::SetColor(image.context(), render::kInk);
  cairo_move_to(image.context(), left, bottom);
  cairo_show_text(image.context(), text.c_str());
  sheet = image.ToImage();
}

void PastePair(const Pair& pair, int left, int top, render::Image& sheet) {
  const object::PolygonSoup soup = object::ReadSoup(pair.file, {}).soup;
  const repair::Repaired repaired = repair::Repair(soup, pair.file.string(), {});
  const SurfaceExtent extent = ExtentOf({&soup, &repaired.solid}, pair.view);
  Paste(DrawSurface(soup, pair.view, extent, kSide), left, top + kTitle, sheet);
  Paste(DrawSurface(repaired.solid, pair.view, extent, kSide), left + kSide + kGap, top + kTitle,
        sheet);
  PasteText(pair.file.stem().string(), left, top + kTitle - kGap, sheet);
  std::printf("%s: %s\n", pair.file.filename().c_str(), repair::RepairText(repaired).c_str());
}

render::Image DrawSheet(const std::vector<Pair>& pairs) {
  constexpr int kWide = 2 * kSide + kGap + kMargin, kHigh = kTitle + kSide + kGap;
  const int rows = (static_cast<int>(pairs.size()) + kColumns - 1) / kColumns;
  render::Image sheet = render::MakeImage(kColumns * kWide + kMargin, rows * kHigh);
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
    PastePair(pairs[i], kMargin + i % kColumns * kWide, i / kColumns * kHigh, sheet);
  }
  return sheet;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Draws files beside what their repair makes of them");
  std::filesystem::path output;
  std::vector<std::string> words;
  app.add_option("OUTPUT", output, "The picture, PNG")->required();
  app.add_option("PICTURES", words, "FILE AZIMUTH ELEVATION of each, degrees of the one who looks")
      ->required()
      ->expected(3, 300);
  CLI11_PARSE(app, argc, argv);
  try {
    render::WritePng(output, DrawSheet(PairsOf(words)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "repair_pictures: %s\n", error.what());
    return kBadUsage;
  }
  return 0;
}
