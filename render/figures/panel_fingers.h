#pragma once

#include <cairo.h>

#include "planner/object/polygon.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/panel_view.h"
#include "render/figures/plan_figure.h"

namespace regrasp::render {

/// Draws the fingers: a marker at each contact with the finger's number beside it; a ring and an
/// arrow that arrives for a placed finger; a hollow marker and an arrow that leaves for a released
/// one; a hollow marker at the start of a moved one, and an arrow beside the border from there to
/// the contact with a tick at each waypoint.
void DrawFingers(cairo_t* cr, const object::Polygon& polygon, const StepDiagram& diagram,
                 const PanelView& view);

/// How far one can go out of the material from a place on the border until the polygon is met
/// again; infinity where it never is.
[[nodiscard]] double OutwardClearance(const object::Polygon& polygon, const BorderPoint& from);

}  // namespace regrasp::render
