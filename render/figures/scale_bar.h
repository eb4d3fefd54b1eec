#pragma once

#include <cairo.h>

#include <Eigen/Core>

namespace regrasp::render {

/// Height that a panel gives to its scale bar, below the object, points.
inline constexpr double kScaleBarSpace = 14;

/// How long the scale bar of a panel `width` points wide is, metres: the longest round length
/// (RoundLength) of at most a quarter of the panel.
[[nodiscard]] double ScaleBarLength(double width, double points_per_metre);

/// Draws it with its length at the bottom right of a panel.
void DrawScaleBar(cairo_t* cr, const Eigen::Vector2d& panel, double points_per_metre);

}  // namespace regrasp::render
