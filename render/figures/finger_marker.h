#pragma once

#include <cairo.h>

#include <Eigen/Core>

#include "planner/plan/snapshot.h"

namespace regrasp::render {

/// Marks a contact: a shape and a colour for each finger (disc, square, triangle, diamond,
/// pentagon; both repeat after five fingers), so that they stay apart in grey.
/// @param radius   points; all shapes look about as large as a disc of this radius.
/// @param outline  only the border, on white: where a finger has left.
void DrawFingerMarker(cairo_t* cr, FingerIndex finger, const Eigen::Vector2d& centre, double radius,
                      bool outline);

}  // namespace regrasp::render
