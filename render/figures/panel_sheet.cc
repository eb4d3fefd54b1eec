#include "render/figures/panel_sheet.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "render/figures/figure_page.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/image.h"

namespace regrasp::render {

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

void DrawPanel(cairo_t* cr, const FigurePanels& panels, int index, double width, double left,
               double top) {
  cairo_save(cr);
  cairo_translate(cr, left, top);
  SetBox(cr, {0, 0}, {width, panels.HeightFor(width)});
  cairo_clip(cr);
  panels.Draw(cr, index, width);
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
    layout.captions.push_back(WrapCaption(panels.caption(indices[i]), layout.panel_width));
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
  const auto draw = [&](cairo_t* cr) { DrawPanel(cr, panels, index, width, 0, 0); };
  return DrawWithCaption(style.format, {width, panels.HeightFor(width)}, panels.caption(index),
                         draw, MagnificationOf(style));
}

std::string DrawSheet(const FigurePanels& panels, std::span<const int> indices,
                      const FigureStyle& style) {
  const SheetLayout layout = LayOut(panels, indices, style);
  FigurePage page(style.format, layout.width(), layout.height(), MagnificationOf(style));
  double top = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::size_t column = i % layout.columns;
    const std::size_t row = i / layout.columns;
    if (row > 0 && column == 0) top += layout.RowHeight(row - 1);
    const double left = static_cast<double>(column) * (layout.panel_width + kGap);
    DrawPanel(page.context(), panels, indices[i], layout.panel_width, left, top);
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

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWhiteRim = 0.5;  ///< width of the rim around a filled marker and its ring, points
constexpr double kOutlineWidth = 0.9;  ///< line width of a hollow marker, points
constexpr double kRingDistance = 1.9;  ///< distance from a marker to its ring, points
constexpr double kRingWidth = 0.8;     ///< line width of a ring, points

/// Visible width of a marker around another one on top, points. A triangle extends to 1.5 radii.
constexpr double kNestedRim = 1.6;

/// A regular polygon with the area of the disc.
struct MarkerShape {
  int corners;   ///< number of corners; 0 for a disc
  double start;  ///< angle of the first corner, radians
};
constexpr std::array<MarkerShape, 5> kShapes = {
    {{0, 0}, {4, kPi / 4}, {3, -kPi / 2}, {4, 0}, {5, -kPi / 2}}};

void AddMarkerPath(cairo_t* cr, const MarkerShape& shape, const Eigen::Vector2d& centre,
                   double radius) {
  if (shape.corners == 0) return SetCircle(cr, centre, radius);
  cairo_new_path(cr);
  const double step = 2 * kPi / shape.corners;
  const double reach = radius * std::sqrt(2 * kPi / (shape.corners * std::sin(step)));
  for (int k = 0; k < shape.corners; ++k) {
    const double angle = shape.start + k * step;
    cairo_line_to(cr, centre.x() + reach * std::cos(angle), centre.y() + reach * std::sin(angle));
  }
  cairo_close_path(cr);
}

}  // namespace

double FingerMarker::reach() const {
  return radius + (ring ? kRingDistance + kRingWidth / 2 + kWhiteRim : 0);
}

void EnlargeCovered(std::span<FingerMarker> markers) {
  for (std::size_t i = markers.size(); i-- > 0;) {
    FingerMarker& below = markers[i];
    for (const FingerMarker& above : markers.subspan(i + 1)) {
      const bool covered = (above.centre - below.centre).norm() < above.reach();
      if (covered) below.radius = std::max(below.radius, above.reach() + kNestedRim);
    }
  }
}

void DrawFingerMarker(cairo_t* cr, const FingerMarker& marker) {
  const Color own = FingerColor(marker.finger);
  const Color color = marker.style == MarkerStyle::kPale ? Paler(own, kBehindShare) : own;
  if (marker.ring) {
    SetCircle(cr, marker.centre, marker.radius + kRingDistance);
    Stroke(cr, kWhite, kRingWidth + 2 * kWhiteRim);
    SetCircle(cr, marker.centre, marker.radius + kRingDistance);
    Stroke(cr, color, kRingWidth);
  }
  const int count = static_cast<int>(kShapes.size());
  const MarkerShape& shape = kShapes[((marker.finger % count) + count) % count];
  AddMarkerPath(cr, shape, marker.centre, marker.radius);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
  if (marker.style == MarkerStyle::kHollow) {
    FillAndStroke(cr, kWhite, color, kOutlineWidth);
  } else {
    FillWithHalo(cr, color, 2 * kWhiteRim);
  }
}

Color Paler(Color color, double share) {
  const auto mix = [share](unsigned char c) {
    return static_cast<unsigned char>(std::lround(255 - share * (255 - c)));
  };
  return {mix(color.r), mix(color.g), mix(color.b)};
}

}  // namespace regrasp::render
