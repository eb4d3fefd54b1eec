#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <span>

#include "planner/base/index.h"
#include "render/picture/image.h"

namespace regrasp::render {

enum class MarkerStyle {
  kFilled,
  kPale,    ///< contact behind the object
  kHollow,  ///< white with a border: position that a finger has left
};

/// Radius of a marker without other markers on top, points.
inline constexpr double kMarkerRadius = 2.7;

/// A marker for the position of a finger. Shapes (disc, square, triangle, diamond, pentagon) and
/// colours differ between fingers, and repeat after five. Markers are therefore distinguishable in
/// greyscale.
struct FingerMarker {
  FingerIndex finger = {};
  Eigen::Vector2d centre;  ///< position, points
  MarkerStyle style = MarkerStyle::kFilled;
  bool ring = false;              ///< whether it has the ring of a placed finger
  double radius = kMarkerRadius;  ///< radius of the disc with the same area, points

  /// Return the distance from the centre to the outer border, with the ring, points.
  [[nodiscard]] double reach() const;
};

/// Enlarge markers that others cover by more than half, so that a rim stays visible. Contacts at
/// one position are drawn nested.
/// @param markers  markers in drawing order.
void EnlargeCovered(std::span<FingerMarker> markers);

void DrawFingerMarker(cairo_t* cr, const FingerMarker& marker);

/// Mix a colour with white.
/// @param share  share of the colour, 0 to 1.
[[nodiscard]] Color Paler(Color color, double share);

/// Share of the colour of elements behind an object.
inline constexpr double kBehindShare = 0.45;

}  // namespace regrasp::render
