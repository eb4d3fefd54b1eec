#include "render/figures/panel_sheet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/figures/figure_page.h"
#include "render/figures/panel_text.h"
#include "render/figures/print_size.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {

namespace {

constexpr double kGap = 8;  ///< between panels of a sheet, points
constexpr int kUsualColumns = 4;
/// Panels as low as this, over their width, would be small in a usual row: a sheet of a long object
/// has fewer columns if it is no taller than a page.
constexpr double kLowPanel = 0.6;
constexpr double kTallestSheet = 235 * kPointsPerMillimetre;

using Lines = std::vector<std::string>;

void DrawPanel(cairo_t* cr, const FigurePanels& panels, int index, double width, double left,
               double top) {
  cairo_save(cr);
  cairo_translate(cr, left, top);
  SetBox(cr, {0, 0}, {width, panels.HeightFor(width)});
  cairo_clip(cr);
  panels.Draw(cr, index, width);
  cairo_restore(cr);
}

/// The lines of every caption, and the most lines of any in each row.
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

SheetLayout LayOutIn(int columns, const FigurePanels& panels) {
  SheetLayout layout;
  layout.columns = columns;
  const int on_page = std::min(columns, kUsualColumns);
  const double width = (kTwoColumnWidth - (on_page - 1) * kGap) / on_page;
  layout.panel_width = std::min(width, kColumnWidth);
  layout.panel_height = panels.HeightFor(layout.panel_width);
  for (int i = 0; i < panels.count(); ++i) {
    layout.captions.push_back(WrapCaption(panels.caption(i), layout.panel_width));
    if (i % columns == 0) layout.most_lines.push_back(0);
    layout.most_lines.back() = std::max(layout.most_lines.back(), layout.captions.back().size());
  }
  return layout;
}

SheetLayout LayOut(const FigurePanels& panels) {
  const int columns = SheetColumns(panels.count());
  SheetLayout usual = LayOutIn(columns, panels);
  const bool low = usual.panel_height < kLowPanel * usual.panel_width;
  for (int fewer = 2; low && fewer < std::min(columns, kUsualColumns); ++fewer) {
    SheetLayout layout = LayOutIn(fewer, panels);
    if (layout.height() <= kTallestSheet) return layout;
  }
  return usual;
}

}  // namespace

int SheetColumns(int count) {
  constexpr int kLargestPage = 24;  ///< panels; six rows of four
  if (count <= 3) return count;
  if (count <= kLargestPage) return count == 5 || count == 6 || count == 9 ? 3 : kUsualColumns;
  return static_cast<int>(std::ceil(std::sqrt(count)));
}

std::string DrawStepFigure(const FigurePanels& panels, int index, FigureFormat format) {
  const double height = panels.HeightFor(kColumnWidth);
  return DrawWithCaption(format, {kColumnWidth, height}, panels.caption(index),
                         [&](cairo_t* cr) { DrawPanel(cr, panels, index, kColumnWidth, 0, 0); });
}

std::string DrawSheet(const FigurePanels& panels, FigureFormat format) {
  const SheetLayout layout = LayOut(panels);
  FigurePage page(format, layout.width(), layout.height());
  double top = 0;
  for (int i = 0; i < panels.count(); ++i) {
    const int column = i % layout.columns;
    const int row = i / layout.columns;
    if (row > 0 && column == 0) top += layout.RowHeight(row - 1);
    const double left = column * (layout.panel_width + kGap);
    DrawPanel(page.context(), panels, i, layout.panel_width, left, top);
    DrawCaption(page.context(), layout.captions[i], left + layout.panel_width / 2,
                top + layout.panel_height);
  }
  return page.Finish();
}

}  // namespace regrasp::render
