#pragma once

#include <memory>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/solid_figure.h"

namespace regrasp::render {

/// The panels of a plan of a polygon (PlanPanels) or of a solid (SolidPanels).
/// @param object  outlives the panels.
/// @param plan    of this object, located and legal (CheckPlan).
/// @param solid   for a solid only.
[[nodiscard]] std::unique_ptr<FigurePanels> MakePanels(const object::Object& object,
                                                       const plan::Plan& plan,
                                                       const SolidFigureOptions& solid = {});

}  // namespace regrasp::render
