#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "render/picture/label_layout.h"

namespace regrasp::render {

/// Of the circle that a finger's number needs, points.
inline constexpr double kNumberRadius = 4.8;

/// Writes names of fingers or grasps next to what they belong to (PlaceLabels), with a line to it
/// where that is not beside the name.
/// @param panel  its size, points; names stay in it.
/// @returns the centres of the names.
std::vector<Eigen::Vector2d> DrawNumbers(cairo_t* cr, std::span<const std::string> names,
                                         std::span<const LabelAnchor> anchors,
                                         std::span<const Obstacle> obstacles,
                                         const Eigen::Vector2d& panel);

}  // namespace regrasp::render
