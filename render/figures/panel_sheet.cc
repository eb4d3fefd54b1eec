#include "render/figures/panel_sheet.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <vector>

#include "render/figures/figure_page.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using namespace std::literals;

/// Length of the signature and the header chunk (PNG specification, 5.2 and 5.3).
constexpr std::size_t kEndOfPngHeader = 8 + 4 + 4 + 13 + 4;

std::string SvgMark() { return "<!-- Creator: " + std::string(kFigureMaker) + " -->\n"; }

std::string PdfMark() { return "/Creator (" + std::string(kFigureMaker) + ")"; }

/// A text chunk contains a registered keyword, a zero byte and the text.
std::string PngMark() { return PngChunk("tEXt", "Software"s + '\0' + kFigureMaker); }

}  // namespace

void MarkFigure(FigureFormat format, std::string& bytes) {
  switch (format) {
    case FigureFormat::kSvg:
      bytes.insert(bytes.find('\n') + 1, SvgMark());
      break;
    case FigureFormat::kPng:
      assert(bytes.size() > kEndOfPngHeader);
      bytes.insert(kEndOfPngHeader, PngMark());
      break;
    case FigureFormat::kPdf:
      break;
  }
}

bool IsMarkedFigure(const std::string& bytes) {
  const auto holds = [&](std::string_view beginning, const std::string& mark) {
    return bytes.starts_with(beginning) && bytes.find(mark) != std::string::npos;
  };
  return holds("<?xml"sv, SvgMark()) || holds("%PDF-"sv, PdfMark()) ||
         holds("\x89PNG"sv, PngMark()) ||
         holds("glTF"sv, "\"name\":\"" + std::string(kFigureMaker) + "\"");
}

namespace {

constexpr double kGap = 8;  ///< gap between panels, points
constexpr int kDefaultColumns = 4;
/// Ratio of height to width below which a panel is low. Sheets of low panels have fewer columns if
/// their height does not exceed a page, because such panels would be small.
constexpr double kLowPanel = 0.6;
constexpr double kTallestSheet = 235 * kPointsPerMillimetre;

double MagnificationOf(const FigureStyle& style) { return style.font_pt / kCaptionFont; }

/// Return the width of the layout at the default font size for a width in print.
double LayoutWidth(double width_mm, const FigureStyle& style) {
  return width_mm * kPointsPerMillimetre / MagnificationOf(style);
}

using Lines = std::vector<std::string>;

void DrawPanel(cairo_t* cr, const FigurePanels& panels, int index, double width,
               const Eigen::Vector2d& corner, bool scale_bar) {
  cairo_save(cr);
  cairo_translate(cr, corner.x(), corner.y());
  SetBox(cr, {0, 0}, {width, panels.HeightFor(width)});
  cairo_clip(cr);
  panels.Draw(cr, index, width, scale_bar);
  cairo_restore(cr);
}

/// Layout of a sheet: the lines of each caption, and the maximum number of lines in each row.
struct SheetLayout {
  int columns;
  double panel_width, panel_height;
  std::vector<Lines> captions;
  std::vector<std::size_t> most_lines;

  [[nodiscard]] double width() const { return columns * (panel_width + kGap) - kGap; }
  [[nodiscard]] double RowHeight(std::size_t row) const {
    return panel_height + CaptionHeight(most_lines[row]);
  }
  [[nodiscard]] double height() const {
    double sum = 0;
    for (std::size_t row = 0; row < most_lines.size(); ++row) sum += RowHeight(row);
    return sum;
  }
};

SheetLayout LayOutIn(int columns, const FigurePanels& panels, std::span<const int> indices,
                     const FigureStyle& style) {
  SheetLayout layout;
  layout.columns = columns;
  const int on_page = std::min(columns, kDefaultColumns);
  const double width = (LayoutWidth(style.sheet_width_mm, style) - (on_page - 1) * kGap) / on_page;
  layout.panel_width = std::min(width, LayoutWidth(style.width_mm, style));
  layout.panel_height = panels.HeightFor(layout.panel_width);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    layout.captions.push_back(
        style.captions ? WrapCaption(panels.caption(indices[i]), layout.panel_width, style.family)
                       : Lines());
    if (i % columns == 0) layout.most_lines.push_back(0);
    layout.most_lines.back() = std::max(layout.most_lines.back(), layout.captions.back().size());
  }
  return layout;
}

SheetLayout LayOut(const FigurePanels& panels, std::span<const int> indices,
                   const FigureStyle& style) {
  const int columns = SheetColumns(static_cast<int>(indices.size()));
  SheetLayout standard = LayOutIn(columns, panels, indices, style);
  const bool low = standard.panel_height < kLowPanel * standard.panel_width;
  for (int fewer = 2; low && fewer < std::min(columns, kDefaultColumns); ++fewer) {
    SheetLayout layout = LayOutIn(fewer, panels, indices, style);
    if (layout.height() * MagnificationOf(style) <= kTallestSheet) return layout;
  }
  return standard;
}

}  // namespace

int SheetColumns(int count) {
  constexpr int kLargestPage = 24;  ///< maximum number of panels on a page: six rows of four
  if (count <= 3) return count;
  if (count <= kLargestPage) return count == 5 || count == 6 || count == 9 ? 3 : kDefaultColumns;
  return static_cast<int>(std::ceil(std::sqrt(count)));
}

std::string DrawStepFigure(const FigurePanels& panels, int index, const FigureStyle& style) {
  const double width = LayoutWidth(style.width_mm, style);
  const auto draw = [&](cairo_t* cr) { DrawPanel(cr, panels, index, width, {0, 0}, true); };
  return DrawWithCaption(style, {width, panels.HeightFor(width)}, panels.caption(index), draw,
                         MagnificationOf(style));
}

std::string DrawSheet(const FigurePanels& panels, std::span<const int> indices,
                      const FigureStyle& style) {
  const SheetLayout layout = LayOut(panels, indices, style);
  FigurePage page(style.format, layout.width(), layout.height(), MagnificationOf(style),
                  style.family);
  double top = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::size_t column = i % layout.columns;
    const std::size_t row = i / layout.columns;
    if (row > 0 && column == 0) top += layout.RowHeight(row - 1);
    const double left = static_cast<double>(column) * (layout.panel_width + kGap);
    DrawPanel(page.context(), panels, indices[i], layout.panel_width, {left, top},
              i + 1 == indices.size());
    DrawCaption(page.context(), layout.captions[i], left + layout.panel_width / 2,
                top + layout.panel_height);
  }
  return page.Finish();
}

std::string DrawSheet(const FigurePanels& panels, const FigureStyle& style) {
  std::vector<int> all(panels.count());
  std::iota(all.begin(), all.end(), 0);
  return DrawSheet(panels, all, style);
}

}  // namespace regrasp::render
