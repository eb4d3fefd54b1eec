#include "render/figures/finger_marker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/picture/cairo_paint.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWhiteRim = 0.5;  ///< width of the rim around a filled marker and its ring, points
constexpr double kOutlineWidth = 0.9;  ///< line width of a hollow marker, points
constexpr double kRingDistance = 1.9;  ///< distance from a marker to its ring, points
constexpr double kRingWidth = 0.8;     ///< line width of a ring, points

/// Visible width of a marker around another one on top, points. A triangle extends to 1.5 radii.
constexpr double kNestedRim = 1.6;

/// A regular polygon with the area of the disc.
struct MarkerShape {
  int corners;   ///< number of corners; 0 for a disc
  double start;  ///< angle of the first corner, radians
};
constexpr std::array<MarkerShape, 5> kShapes = {
    {{0, 0}, {4, kPi / 4}, {3, -kPi / 2}, {4, 0}, {5, -kPi / 2}}};

void AddMarkerPath(cairo_t* cr, const MarkerShape& shape, const Eigen::Vector2d& centre,
                   double radius) {
  if (shape.corners == 0) return SetCircle(cr, centre, radius);
  cairo_new_path(cr);
  const double step = 2 * kPi / shape.corners;
  const double reach = radius * std::sqrt(2 * kPi / (shape.corners * std::sin(step)));
  for (int k = 0; k < shape.corners; ++k) {
    const double angle = shape.start + k * step;
    cairo_line_to(cr, centre.x() + reach * std::cos(angle), centre.y() + reach * std::sin(angle));
  }
  cairo_close_path(cr);
}

}  // namespace

double FingerMarker::reach() const {
  return radius + (ring ? kRingDistance + kRingWidth / 2 + kWhiteRim : 0);
}

void EnlargeCovered(std::span<FingerMarker> markers) {
  for (std::size_t i = markers.size(); i-- > 0;) {
    FingerMarker& below = markers[i];
    for (const FingerMarker& above : markers.subspan(i + 1)) {
      const bool covered = (above.centre - below.centre).norm() < above.reach();
      if (covered) below.radius = std::max(below.radius, above.reach() + kNestedRim);
    }
  }
}

void DrawFingerMarker(cairo_t* cr, const FingerMarker& marker) {
  const Color own = FingerColor(marker.finger);
  const Color color = marker.style == MarkerStyle::kPale ? Paler(own, kBehindShare) : own;
  if (marker.ring) {
    SetCircle(cr, marker.centre, marker.radius + kRingDistance);
    Stroke(cr, kWhite, kRingWidth + 2 * kWhiteRim);
    SetCircle(cr, marker.centre, marker.radius + kRingDistance);
    Stroke(cr, color, kRingWidth);
  }
  const int count = static_cast<int>(kShapes.size());
  const MarkerShape& shape = kShapes[((marker.finger % count) + count) % count];
  AddMarkerPath(cr, shape, marker.centre, marker.radius);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
  if (marker.style == MarkerStyle::kHollow) {
    FillAndStroke(cr, kWhite, color, kOutlineWidth);
  } else {
    FillWithHalo(cr, color, 2 * kWhiteRim);
  }
}

Color Paler(Color color, double share) {
  const auto mix = [share](unsigned char c) {
    return static_cast<unsigned char>(std::lround(255 - share * (255 - c)));
  };
  return {mix(color.r), mix(color.g), mix(color.b)};
}

}  // namespace regrasp::render
