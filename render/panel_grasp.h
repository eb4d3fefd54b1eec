#pragma once

#include <cairo.h>

#include <span>

#include "render/grasp_diagram.h"
#include "render/panel_view.h"
#include "render/plan_diagram.h"

namespace regrasp {

/// Draws the cones of a grasp, translucent, in their fingers' colours: both sides of each, as long
/// as it takes to see them, and beyond the focus point on its side.
/// @param length  of a side, points.
void DrawCones(cairo_t* cr, const StepDiagram& diagram, const PanelView& view, double length);

/// Hatches the focus cell.
void DrawFocusCell(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

/// Draws what the type of the grasp is known by: thin lines from the focus point to the contacts;
/// the parallel lines of force; the dashed line through two contacts.
void DrawForceLines(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

/// Marks the focus point.
void DrawFocusPoint(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

}  // namespace regrasp
