#include "render/figures/panel_view.h"

#include <algorithm>
#include <cassert>

namespace regrasp::render {

namespace {

using Box = Eigen::AlignedBox2d;

Box BoxOf(const object::Polygon& polygon) {
  Box box;
  for (const Eigen::Vector2d& p : polygon.rings().front()) box.extend(p);
  return box;
}

}  // namespace

PanelView FitView(const object::Polygon& polygon, std::span<const StepDiagram> diagrams,
                  double width) {
  assert(width > 2 * kPanelMargin);
  const Box object = BoxOf(polygon);
  Box shown = object;
  for (const StepDiagram& diagram : diagrams) {
    const auto& focus = diagram.grasp.focus;
    const bool near = focus && object.exteriorDistance(*focus) <= kFocusOnPage * polygon.diameter();
    if (near) shown.extend(*focus);
  }
  const Eigen::Vector2d size = shown.sizes();
  const double space = width - 2 * kPanelMargin;
  const double tallest = kTallestPanel * width - 2 * kPanelMargin;
  PanelView view;
  view.width = width;
  view.scale = std::min(space / size.x(), tallest / size.y());
  view.height = view.scale * size.y() + 2 * kPanelMargin;
  view.centre = shown.center();
  return view;
}

}  // namespace regrasp::render
