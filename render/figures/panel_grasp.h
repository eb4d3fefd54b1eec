#pragma once

#include <cairo.h>

#include <span>

#include "render/figures/grasp_diagram.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/panel_view.h"
#include "render/figures/plan_figure.h"

namespace regrasp::render {

/// How long a side of a cone is drawn, points: on the inner side a share of the polygon's diameter,
/// less where the panel ends, on the outer side no more than the panel's margin, and in both cases
/// beyond a focus point there.
/// @param side  1 the inner side, −1 the outer one.
[[nodiscard]] double ConeLength(const object::Polygon& polygon, const GraspDiagram& grasp,
                                const DoubleCone& cone, int side, const PanelView& view);

/// Draws the cones of a grasp, translucent, in their fingers' colours, both sides of each.
void DrawCones(cairo_t* cr, const object::Polygon& polygon, const StepDiagram& diagram,
               const PanelView& view);

/// Hatches the focus cell.
void DrawFocusCell(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

/// Draws what the type of the grasp is known by: thin lines from the focus point to the contacts;
/// the parallel lines of force; the dashed line through two contacts.
void DrawForceLines(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

/// Marks the focus point.
void DrawFocusPoint(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

}  // namespace regrasp::render
