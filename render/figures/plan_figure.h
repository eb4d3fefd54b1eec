#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/plan/plan.h"
#include "planner/plan/snapshot.h"
#include "render/figures/grasp_diagram.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/solid_figure.h"

namespace regrasp::render {

/// A place on the polygon's border and the unit normal that points out of the material there.
struct BorderPoint {
  Eigen::Vector2d p;
  Eigen::Vector2d outward;
};

/// One finger in a figure.
struct DiagramFinger {
  FingerIndex finger = {};
  plan::FingerRole role = plan::FingerRole::kHolding;
  BorderPoint contact;
  /// The path of a moved finger, its start first and its contact last; empty for the others.
  std::vector<BorderPoint> path;
};

/// What a figure shows of one entry of a plan: the grasp after it, and what the fingers did.
struct StepDiagram {
  std::string kind;     ///< "hold", or as StepKind
  std::string caption;  ///< "(a) hold: fingers 0, 1, 2; concurrent grasp"
  GraspDiagram grasp;   ///< its cones belong to the first of `fingers`, in their order
  std::vector<DiagramFinger> fingers;  ///< those that hold after the step, then released ones
};

/// The figures of a plan: the hold of the initial grasp, then one for each step.
///
/// The caption says what happens, the type of the grasp after it, and the cones' half-angle φ where
/// it is smaller than the friction's θ.
/// @param plan  of this polygon, located (LocatePlan), and legal (CheckPlan).
[[nodiscard]] std::vector<StepDiagram> DescribePlan(const object::Polygon& polygon,
                                                    const plan::Plan& plan);

/// "(a)" … "(z)", "(aa)", "(ab)" …
[[nodiscard]] std::string PanelLabel(int index);

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

/// The panels of a plan of a polygon (PlanPanels) or of a solid (SolidPanels).
/// @param object  outlives the panels.
/// @param plan    of this object, located and legal (CheckPlan).
/// @param solid   for a solid only.
[[nodiscard]] std::unique_ptr<FigurePanels> MakePanels(const object::Object& object,
                                                       const plan::Plan& plan,
                                                       const SolidFigureOptions& solid = {});

}  // namespace regrasp::render
