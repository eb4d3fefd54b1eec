#include "render/figures/plan_figure.h"

#include <vector>

#include "render/figures/panel_fingers.h"
#include "render/figures/panel_grasp.h"
#include "render/figures/panel_view.h"
#include "render/figures/scale_bar.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/palette.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

constexpr double kBorderWidth = 0.9;  ///< of the polygon, points

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

}  // namespace

double PlanPanels::HeightFor(double width) const {
  return FitView(polygon_, diagrams_, width).height + kScaleBarSpace;
}

void PlanPanels::Draw(cairo_t* cr, int index, double width) const {
  const PanelView view = FitView(polygon_, diagrams_, width);
  const StepDiagram& diagram = diagrams_[index];
  AddPolygon(cr, polygon_, view);
  Fill(cr, kMaterial);
  DrawFocusCell(cr, diagram.grasp, view);
  DrawCones(cr, polygon_, diagram, view);
  AddPolygon(cr, polygon_, view);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  Stroke(cr, kInk, kBorderWidth);
  DrawForceLines(cr, diagram.grasp, view);
  DrawFingers(cr, polygon_, diagram, view);
  DrawFocusPoint(cr, diagram.grasp, view);
  DrawScaleBar(cr, {width, view.height + kScaleBarSpace}, view.scale / metres_per_unit_);
}

}  // namespace regrasp::render
