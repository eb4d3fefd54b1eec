#include "render/figures/panel_grasp.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "render/picture/cairo_paint.h"
#include "render/picture/color_table.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

// Points, unless said otherwise.
constexpr double kPanelConeLength = 0.2;  ///< of the polygon's diameter
constexpr double kConeBorder = 0.4;
constexpr double kConeFill = 0.26;  ///< opacity
constexpr double kLongConeFill = 0.12;
constexpr double kConeBorderOpacity = 0.8;
constexpr double kBeyondFocus = 1.12;  ///< of the distance from the contact to the focus point
constexpr double kLongestOuter = kPanelMargin - 2;  ///< so that cones end on the panel
constexpr double kConeInset = 1;                    ///< from the panel's border
constexpr double kShortestInner = 12;               ///< whatever space there is
constexpr Hatch kConeHatch = {.slope = 1, .spacing = 3.2, .width = 0.35};
constexpr double kCellBorder = 0.5;
constexpr double kForceLine = 0.55;
constexpr double kForceLineInset = 4;  ///< from the panel's border
constexpr double kConeDash = 3;
constexpr double kFocusRadius = 1.7;

constexpr Color kConeHatchInk = {168, 174, 184};
constexpr Color kCellInk = {96, 104, 118};

/// What is between two distances from the apex of one side of a cone.
struct Sector {
  Vector2d apex;
  double middle;      ///< angle of the axis, radians
  double half_angle;  ///< radians
  double from = 0;
  double to = 0;
};

void FillSector(cairo_t* cr, const Sector& sector, Color color, double opacity) {
  const auto& [apex, middle, half_angle, from, to] = sector;
  cairo_new_path(cr);
  cairo_arc(cr, apex.x(), apex.y(), to, middle - half_angle, middle + half_angle);
  if (from > 0) {
    cairo_arc_negative(cr, apex.x(), apex.y(), from, middle + half_angle, middle - half_angle);
  } else {
    cairo_line_to(cr, apex.x(), apex.y());
  }
  cairo_close_path(cr);
  Fill(cr, color, opacity);
}

/// One side of a cone with a round end; paler where it is longer than `usual`.
void DrawSide(cairo_t* cr, const Vector2d& apex, const Vector2d& axis, double half_angle,
              double usual, double length, Color color) {
  const double middle = std::atan2(axis.y(), axis.x());
  FillSector(cr, {apex, middle, half_angle, 0, std::min(usual, length)}, color, kConeFill);
  if (length > usual) {
    FillSector(cr, {apex, middle, half_angle, usual, length}, color, kLongConeFill);
  }
  SetColor(cr, color, kConeBorderOpacity);
  for (const double side : {-half_angle, half_angle}) {
    const Vector2d direction(std::cos(middle + side), std::sin(middle + side));
    StrokeLine(cr, apex, apex + length * direction, kConeBorder);
  }
}

/// How far a side of a cone can be drawn on the panel, its borders included.
double LengthOnPanel(const DoubleCone& cone, int side, const PanelView& view) {
  const Vector2d apex = view.ToPanel(cone.apex);
  const Vector2d axis = side * PanelView::ToPanelDirection(cone.axis);
  const Vector2d corner(view.width, view.height);
  double length = corner.norm();
  for (const double turn : {-cone.half_angle, 0.0, cone.half_angle}) {
    const Vector2d direction = Eigen::Rotation2Dd(turn) * axis;
    for (int k = 0; k < 2; ++k) {
      if (direction[k] == 0) continue;
      const double border = direction[k] > 0 ? corner[k] - kConeInset : kConeInset;
      length = std::min(length, (border - apex[k]) / direction[k]);
    }
  }
  return length;
}

double UsualLength(const object::Polygon& polygon, const DoubleCone& cone, int side,
                   const PanelView& view) {
  const double usual = kPanelConeLength * view.scale * polygon.diameter();
  if (side < 0) return std::min(usual, kLongestOuter);
  return std::min(usual, std::max(LengthOnPanel(cone, side, view), kShortestInner));
}

/// The part of the line through `p` along `d` on the panel, a little inside its border.
std::array<Vector2d, 2> LineOnPanel(const Vector2d& p, const Vector2d& d, const PanelView& view) {
  const Vector2d corner(view.width, view.height);
  double from = -corner.norm();
  double to = corner.norm();
  for (int k = 0; k < 2; ++k) {
    if (d[k] == 0) continue;
    const double a = (kForceLineInset - p[k]) / d[k];
    const double b = (corner[k] - kForceLineInset - p[k]) / d[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return {p + from * d, p + to * d};
}

std::vector<Vector2d> OnPanel(const Outline& outline, const PanelView& view) {
  std::vector<Vector2d> points;
  for (const Vector2d& p : outline) points.push_back(view.ToPanel(p));
  return points;
}

}  // namespace

double ConeLength(const object::Polygon& polygon, const GraspDiagram& grasp, const DoubleCone& cone,
                  int side, const PanelView& view) {
  const double length = UsualLength(polygon, cone, side, view);
  if (!grasp.focus || side * cone.axis.dot(*grasp.focus - cone.apex) <= 0) return length;
  return std::max(length, kBeyondFocus * view.scale * (*grasp.focus - cone.apex).norm());
}

void DrawCones(cairo_t* cr, const object::Polygon& polygon, const StepDiagram& diagram,
               const PanelView& view) {
  const GraspDiagram& grasp = diagram.grasp;
  for (std::size_t i = 0; i < grasp.cones.size(); ++i) {
    const DoubleCone& cone = grasp.cones[i];
    for (const int side : {1, -1}) {
      DrawSide(cr, view.ToPanel(cone.apex), side * PanelView::ToPanelDirection(cone.axis),
               cone.half_angle, UsualLength(polygon, cone, side, view),
               ConeLength(polygon, grasp, cone, side, view),
               FingerColor(diagram.fingers[i].finger));
    }
  }
}

void DrawFocusCell(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view) {
  if (grasp.focus_cell.empty()) return;
  cairo_save(cr);
  cairo_new_path(cr);
  for (const Outline& part : grasp.focus_cell) AddOutline(cr, OnPanel(part, view));
  cairo_clip(cr);
  DrawHatch(cr, {0, 0}, {view.width, view.height}, kConeHatch, kConeHatchInk);
  cairo_restore(cr);
  cairo_new_path(cr);
  for (const Outline& part : grasp.focus_cell) AddOutline(cr, OnPanel(part, view));
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  Stroke(cr, kCellInk, kCellBorder);
}

void DrawForceLines(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view) {
  SetColor(cr, kInk);
  for (const DoubleCone& cone : grasp.cones) {
    const Vector2d p = view.ToPanel(cone.apex);
    if (grasp.focus) StrokeLine(cr, p, view.ToPanel(*grasp.focus), kForceLine);
    if (grasp.force_direction) {
      const auto [a, b] = LineOnPanel(p, PanelView::ToPanelDirection(*grasp.force_direction), view);
      StrokeLine(cr, a, b, kForceLine);
    }
  }
  if (grasp.kind == DiagramKind::kTwoFinger) {
    cairo_set_dash(cr, &kConeDash, 1, 0);
    StrokeLine(cr, view.ToPanel(grasp.cones[0].apex), view.ToPanel(grasp.cones[1].apex),
               kForceLine);
    cairo_set_dash(cr, nullptr, 0, 0);
  }
}

void DrawFocusPoint(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view) {
  if (grasp.focus) DrawDot(cr, view.ToPanel(*grasp.focus), kFocusRadius);
}

}  // namespace regrasp::render
