#include "render/figures/plan_figure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/figures/figure_page.h"
#include "render/figures/panel_fingers.h"
#include "render/figures/panel_grasp.h"
#include "render/figures/panel_text.h"
#include "render/figures/panel_view.h"
#include "render/figures/print_size.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/palette.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

constexpr double kGap = 8;  ///< between panels of a sheet, points
constexpr int kUsualColumns = 4;
/// Panels as low as this, over their width, would be small in a usual row: a sheet of a long object
/// has fewer columns if it is no taller than a page.
constexpr double kLowPanel = 0.6;
constexpr double kTallestSheet = 235 * kPointsPerMillimetre;

constexpr double kBorderWidth = 0.9;  ///< of the polygon, points
constexpr Color kMaterial = {234, 238, 243};

using Lines = std::vector<std::string>;

void AddPolygon(cairo_t* cr, const object::Polygon& polygon, const PanelView& view) {
  cairo_new_path(cr);
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
  for (const auto& ring : polygon.rings()) {
    std::vector<Vector2d> points;
    points.reserve(ring.size());
    for (const Vector2d& p : ring) points.push_back(view.ToPanel(p));
    AddOutline(cr, points);
  }
}

void DrawPanel(cairo_t* cr, const object::Polygon& polygon, const StepDiagram& diagram,
               const PanelView& view, const Vector2d& corner) {
  cairo_save(cr);
  cairo_translate(cr, corner.x(), corner.y());
  SetBox(cr, {0, 0}, {view.width, view.height});
  cairo_clip(cr);
  AddPolygon(cr, polygon, view);
  Fill(cr, kMaterial);
  DrawFocusCell(cr, diagram.grasp, view);
  DrawCones(cr, polygon, diagram, view);
  AddPolygon(cr, polygon, view);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  Stroke(cr, kInk, kBorderWidth);
  DrawForceLines(cr, diagram.grasp, view);
  DrawFingers(cr, polygon, diagram, view);
  DrawFocusPoint(cr, diagram.grasp, view);
  cairo_restore(cr);
}

/// The lines of every caption, and the most lines of any in each row.
struct SheetLayout {
  int columns;
  PanelView view;
  std::vector<Lines> captions;
  std::vector<std::size_t> most_lines;

  [[nodiscard]] double width() const { return columns * (view.width + kGap) - kGap; }
  [[nodiscard]] double RowHeight(std::size_t row) const {
    return view.height + CaptionHeight(most_lines[row]);
  }
  [[nodiscard]] double height() const {
    double sum = 0;
    for (std::size_t row = 0; row < most_lines.size(); ++row) sum += RowHeight(row);
    return sum;
  }
};

SheetLayout LayOutIn(int columns, const object::Polygon& polygon,
                     std::span<const StepDiagram> diagrams) {
  SheetLayout layout;
  layout.columns = columns;
  const int on_page = std::min(columns, kUsualColumns);
  const double panel = (kTwoColumnWidth - (on_page - 1) * kGap) / on_page;
  layout.view = FitView(polygon, diagrams, std::min(panel, kColumnWidth));
  for (std::size_t i = 0; i < diagrams.size(); ++i) {
    layout.captions.push_back(WrapCaption(diagrams[i].caption, layout.view.width));
    if (i % columns == 0) layout.most_lines.push_back(0);
    layout.most_lines.back() = std::max(layout.most_lines.back(), layout.captions.back().size());
  }
  return layout;
}

SheetLayout LayOut(const object::Polygon& polygon, std::span<const StepDiagram> diagrams) {
  const int columns = SheetColumns(static_cast<int>(diagrams.size()));
  SheetLayout usual = LayOutIn(columns, polygon, diagrams);
  const bool low = usual.view.height < kLowPanel * usual.view.width;
  for (int fewer = 2; low && fewer < std::min(columns, kUsualColumns); ++fewer) {
    SheetLayout layout = LayOutIn(fewer, polygon, diagrams);
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

std::string DrawStepFigure(const object::Polygon& polygon, std::span<const StepDiagram> diagrams,
                           int index, FigureFormat format) {
  const StepDiagram& diagram = diagrams[index];
  const PanelView view = FitView(polygon, diagrams, kColumnWidth);
  return DrawWithCaption(format, {view.width, view.height}, diagram.caption, [&](cairo_t* cr) {
    DrawPanel(cr, polygon, diagram, view, {0, 0});
  });
}

std::string DrawSheet(const object::Polygon& polygon, std::span<const StepDiagram> diagrams,
                      FigureFormat format) {
  const SheetLayout layout = LayOut(polygon, diagrams);
  FigurePage page(format, layout.width(), layout.height());
  double top = 0;
  for (std::size_t i = 0; i < diagrams.size(); ++i) {
    const std::size_t column = i % layout.columns;
    const std::size_t row = i / layout.columns;
    if (row > 0 && column == 0) top += layout.RowHeight(row - 1);
    const double left = static_cast<double>(column) * (layout.view.width + kGap);
    DrawPanel(page.context(), polygon, diagrams[i], layout.view, {left, top});
    DrawCaption(page.context(), layout.captions[i], left + layout.view.width / 2,
                top + layout.view.height);
  }
  return page.Finish();
}

}  // namespace regrasp::render
