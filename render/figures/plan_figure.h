#pragma once

#include <string>
#include <vector>

#include "planner/object/polygon.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/plan_diagram.h"

namespace regrasp::render {

/// The panels of a planar plan, one for each step.
///
/// Each shows the polygon, the grasp (render/figures/panel_grasp.h) and what the fingers do
/// (render/figures/panel_fingers.h). Sizes are those of print: lines from 0.35 points, text of 7.5
/// points. All panels of a figure have one scale.
///
/// Laws: the same plan gives the same bytes.
class PlanPanels final : public FigurePanels {
 public:
  /// @param polygon          outlives this object.
  /// @param metres_per_unit  of the polygon, for the scale bar.
  PlanPanels(const object::Polygon& polygon, std::vector<StepDiagram> diagrams,
             double metres_per_unit = 1)
      : polygon_(polygon), diagrams_(std::move(diagrams)), metres_per_unit_(metres_per_unit) {}

  [[nodiscard]] int count() const override { return static_cast<int>(diagrams_.size()); }
  [[nodiscard]] std::string caption(int index) const override { return diagrams_[index].caption; }
  [[nodiscard]] double HeightFor(double width) const override;
  void Draw(cairo_t* cr, int index, double width) const override;

 private:
  const object::Polygon& polygon_;
  std::vector<StepDiagram> diagrams_;
  double metres_per_unit_;
};

}  // namespace regrasp::render
