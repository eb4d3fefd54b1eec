#pragma once

#include <cairo.h>

#include <Eigen/Core>

#include "planner/base/index.h"
#include "render/picture/palette.h"

namespace regrasp::render {

enum class MarkerStyle {
  kFilled,
  kPale,    ///< where the contact is behind the object
  kHollow,  ///< only the border, on white: where a finger has left
};

/// Marks a contact: a shape and a colour for each finger (disc, square, triangle, diamond,
/// pentagon; both repeat after five fingers), so that they stay apart in grey.
/// @param radius  points; all shapes look about as large as a disc of this radius.
void DrawFingerMarker(cairo_t* cr, FingerIndex finger, const Eigen::Vector2d& centre, double radius,
                      MarkerStyle style);

/// A colour that is `share` of it and white for the rest.
[[nodiscard]] Color Paler(Color color, double share);

/// How much of its colour is left of what is behind an object.
inline constexpr double kBehindShare = 0.45;

}  // namespace regrasp::render
