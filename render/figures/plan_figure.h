#pragma once

#include <span>
#include <string>

#include "planner/object/polygon.h"
#include "render/figures/figure_format.h"
#include "render/figures/plan_diagram.h"

namespace regrasp::render {

/// Figures of a planar plan for a paper, as files' bytes: one panel for each step, as wide as a
/// column (85 mm), or a sheet of all panels as wide as two columns (174 mm), in rows.
///
/// Every panel shows the polygon, the grasp (render/figures/panel_grasp.h) and what the fingers do
/// (render/figures/panel_fingers.h), with its caption below. Sizes are those of print: lines from
/// 0.35 points, text of 7.5 points. All panels of a figure have one scale; long objects have fewer
/// in a row. More than 24 steps make the sheet wider, not the panels smaller.
///
/// Laws: the same plan gives the same bytes.
/// @throws EnvironmentError  Cairo failed.
[[nodiscard]] std::string DrawStepFigure(const object::Polygon& polygon,
                                         std::span<const StepDiagram> diagrams, int index,
                                         FigureFormat format);
[[nodiscard]] std::string DrawSheet(const object::Polygon& polygon,
                                    std::span<const StepDiagram> diagrams, FigureFormat format);

/// Panels in a row of a sheet of `count` (> 0), of objects that are not long.
[[nodiscard]] int SheetColumns(int count);

}  // namespace regrasp::render
