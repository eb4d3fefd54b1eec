#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <span>

#include "render/picture/palette.h"

namespace regrasp::render {

inline constexpr Color kWhite = {255, 255, 255};

/// Sets what the next stroke or fill paints with.
void SetColor(cairo_t* cr, Color color, double opacity = 1);

/// Adds a closed path through these points to the current one.
void AddOutline(cairo_t* cr, std::span<const Eigen::Vector2d> points);

/// Strokes a straight line with the current colour.
void StrokeLine(cairo_t* cr, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width);

/// The head of every arrow, points.
inline constexpr double kArrowHead = 4.2;

/// Strokes an open path with the current colour and ends it with an arrow head whose tip is the
/// last point. A path shorter than the head gets a head that fits it.
void StrokeArrow(cairo_t* cr, std::span<const Eigen::Vector2d> path, double width);

}  // namespace regrasp::render
