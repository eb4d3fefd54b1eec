#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/plan/plan.h"
#include "planner/plan/projection.h"
#include "render/figures/grasp_diagram.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/solid_figure.h"

namespace regrasp::render {

/// A point on the border of a polygon with the outward unit normal.
struct BorderPoint {
  Eigen::Vector2d p;
  Eigen::Vector2d outward;
};

/// A finger in a figure.
struct DiagramFinger {
  FingerIndex finger = {};
  plan::FingerRole role = plan::FingerRole::kHolding;
  BorderPoint contact;
  /// path of a sliding finger from its start to its contact; empty for other fingers
  std::vector<BorderPoint> path;
};

/// Content of the panel of a plan entry: the grasp after it, and the actions of the fingers.
struct StepDiagram {
  std::string kind;     ///< "hold", or the result of StepKind
  std::string caption;  ///< caption, for example "(a) hold: fingers 0, 1, 2; concurrent grasp"
  GraspDiagram
      grasp;  ///< diagram of the grasp; its cones belong to the first of `fingers`, in order
  std::vector<DiagramFinger> fingers;  ///< fingers in contact after the step, then released ones
};

/// Compute the panels of a plan: the initial grasp, then one panel per step.
///
/// A caption states the step, the type of the grasp after it, and the angle φ of the cones if it is
/// smaller than the friction angle θ.
/// @param plan  valid plan (CheckPlan) that is located on the polygon (ProjectPlan).
[[nodiscard]] std::vector<StepDiagram> DescribePlan(const object::Polygon& polygon,
                                                    const plan::Plan& plan);

/// Return the label of a panel: "(a)" … "(z)", "(aa)", "(ab)" …
[[nodiscard]] std::string PanelLabel(int index);

/// The panels of a planar plan, one per entry.
///
/// Each panel shows the polygon, the grasp and the actions of the fingers
/// (render/figures/planar_panel.h). All panels of a figure have one scale. Deterministic.
class PlanPanels final : public FigurePanels {
 public:
  /// Create the panels.
  /// @param polygon          must outlive this object.
  /// @param metres_per_unit  unit of the polygon in metres, for the scale bar.
  PlanPanels(const object::Polygon& polygon, std::vector<StepDiagram> diagrams,
             double metres_per_unit = 1)
      : polygon_(polygon), diagrams_(std::move(diagrams)), metres_per_unit_(metres_per_unit) {}

  [[nodiscard]] int count() const override { return static_cast<int>(diagrams_.size()); }
  [[nodiscard]] std::string caption(int index) const override { return diagrams_[index].caption; }
  [[nodiscard]] double HeightFor(double width) const override;
  void Draw(cairo_t* cr, int index, double width, bool scale_bar = true) const override;

 private:
  const object::Polygon& polygon_;
  std::vector<StepDiagram> diagrams_;
  double metres_per_unit_;
};

/// Create the panels of a plan for a polygon (PlanPanels) or a solid (SolidPanels).
/// @param object  must outlive the panels.
/// @param plan    valid plan (CheckPlan) that is located on the object.
/// @param solid   options for a solid.
[[nodiscard]] std::unique_ptr<FigurePanels> MakePanels(const object::Object& object,
                                                       const plan::Plan& plan,
                                                       const SolidFigureOptions& solid = {});

}  // namespace regrasp::render
