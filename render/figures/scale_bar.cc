#include "render/figures/scale_bar.h"

#include "planner/base/quantity_text.h"
#include "render/figures/panel_text.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/palette.h"
#include "render/picture/round_length.h"

namespace regrasp::render {

namespace {

// Points.
constexpr double kInset = 5;  ///< from the panel's right border
constexpr double kWidth = 0.6;
constexpr double kBarTick = 1.5;
constexpr double kTextAbove = 2.5;

constexpr double kLongest = 0.25;  ///< of the panel's width

}  // namespace

double ScaleBarLength(double width, double points_per_metre) {
  return RoundLength(kLongest * width / points_per_metre);
}

void DrawScaleBar(cairo_t* cr, const Eigen::Vector2d& panel, double points_per_metre) {
  const double metres = ScaleBarLength(panel.x(), points_per_metre);
  const double right = panel.x() - kInset;
  const double left = right - metres * points_per_metre;
  const double y = panel.y() - kWidth;
  SetColor(cr, kInk);
  StrokeLine(cr, {left, y}, {right, y}, kWidth);
  for (const double x : {left, right}) StrokeLine(cr, {x, y - kBarTick}, {x, y}, kWidth);
  DrawLabel(cr, FormatLength(metres), {(left + right) / 2, y - kTextAbove}, TextAlign::kCentre);
}

}  // namespace regrasp::render
