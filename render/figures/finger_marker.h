#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <span>

#include "planner/base/index.h"
#include "render/picture/color_table.h"

namespace regrasp::render {

enum class MarkerStyle {
  kFilled,
  kPale,    ///< where the contact is behind the object
  kHollow,  ///< only the border, on white: where a finger has left
};

/// Of a marker on which no other lies, points.
inline constexpr double kMarkerRadius = 2.7;

/// Marks where a finger is: a shape and a colour for each finger (disc, square, triangle, diamond,
/// pentagon; both repeat after five fingers), so that they stay apart in grey.
struct FingerMarker {
  FingerIndex finger = {};
  Eigen::Vector2d centre;  ///< points
  MarkerStyle style = MarkerStyle::kFilled;
  bool ring = false;              ///< around it, of a finger just placed
  double radius = kMarkerRadius;  ///< all shapes look about as large as a disc of this radius

  /// How far it reaches with its ring, points.
  [[nodiscard]] double reach() const;
};

/// Enlarges those that others cover by more than half, so that a rim is seen of each: contacts at
/// one place are nested, at their true place.
/// @param markers  in the order in which they are drawn.
void EnlargeCovered(std::span<FingerMarker> markers);

void DrawFingerMarker(cairo_t* cr, const FingerMarker& marker);

/// A colour that is `share` of it and white for the rest.
[[nodiscard]] Color Paler(Color color, double share);

/// How much of its colour is left of what is behind an object.
inline constexpr double kBehindShare = 0.45;

}  // namespace regrasp::render
