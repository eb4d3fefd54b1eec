#include "render/figures/contact_space_paint.h"

#include <array>
#include <vector>

#include "render/picture/cairo_paint.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

// Points.
/// Steeper than most lines of a set.
constexpr Hatch kHatch = {.slope = 2, .spacing = 2.4, .width = 0.3};
constexpr double kDash = 2.4;
constexpr double kDotDash = 0.8;

void AddPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces) {
  cairo_new_path(cr);
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_WINDING);
  std::vector<Vector2d> points;
  for (const Outline& outline : pieces) {
    points.clear();
    for (const Vector2d& p : outline) points.push_back(window.ToPage(p));
    AddOutline(cr, points);
  }
}

}  // namespace

Color PlanSetTint(int index) {
  static constexpr std::array<Color, 6> kTints = {{
      {128, 177, 218},  // blue
      {247, 206, 108},  // amber
      {150, 214, 176},  // green
      {204, 148, 186},  // mauve
      {240, 160, 124},  // coral
      {178, 172, 224},  // violet
  }};
  return kTints[index % kTints.size()];
}

Color OtherSetTint(sets::SetIndex set) {
  static constexpr std::array<unsigned char, 3> kGreys = {224, 236, 213};
  const unsigned char grey = kGreys[set % kGreys.size()];
  return {grey, grey, grey};
}

void SaveAndClip(cairo_t* cr, const PlotWindow& window) {
  cairo_save(cr);
  SetBox(cr, window.corner, window.size());
  cairo_clip(cr);
}

void FillPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces,
                Color color) {
  AddPieces(cr, window, pieces);
  Fill(cr, color);
}

void HatchPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces,
                 Color color) {
  if (pieces.empty()) return;
  cairo_save(cr);
  AddPieces(cr, window, pieces);
  cairo_clip(cr);
  DrawHatch(cr, window.corner, window.size(), kHatch, color);
  cairo_restore(cr);
}

void StrokeSegments(cairo_t* cr, const PlotWindow& window, std::span<const Segment> segments,
                    Color color, double width) {
  cairo_new_path(cr);
  for (const Segment& segment : segments) {
    const Vector2d a = window.ToPage(segment[0]);
    const Vector2d b = window.ToPage(segment[1]);
    cairo_move_to(cr, a.x(), a.y());
    cairo_line_to(cr, b.x(), b.y());
  }
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  Stroke(cr, color, width);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
}

void SetDash(cairo_t* cr) { cairo_set_dash(cr, &kDash, 1, 0); }

void SetDots(cairo_t* cr) { cairo_set_dash(cr, &kDotDash, 1, 0); }

void ClearDash(cairo_t* cr) { cairo_set_dash(cr, nullptr, 0, 0); }

}  // namespace regrasp::render
