#include "render/figures/finger_marker.h"

#include <array>
#include <cmath>
#include <numbers>

#include "render/picture/cairo_paint.h"
#include "render/picture/palette.h"

namespace regrasp::render {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWhiteRim = 0.5;      ///< points, around a filled marker
constexpr double kOutlineWidth = 0.9;  ///< points

/// A regular polygon of the same area as the disc.
struct MarkerShape {
  int corners;   ///< 0 for a disc
  double start;  ///< angle of the first corner, radians
};
constexpr std::array<MarkerShape, 5> kShapes = {
    {{0, 0}, {4, kPi / 4}, {3, -kPi / 2}, {4, 0}, {5, -kPi / 2}}};

void AddPath(cairo_t* cr, const MarkerShape& shape, const Eigen::Vector2d& centre, double radius) {
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

void DrawFingerMarker(cairo_t* cr, FingerIndex finger, const Eigen::Vector2d& centre, double radius,
                      MarkerStyle style) {
  const int count = static_cast<int>(kShapes.size());
  const MarkerShape& shape = kShapes[((finger % count) + count) % count];
  AddPath(cr, shape, centre, radius);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
  const Color color = FingerColor(finger);
  if (style == MarkerStyle::kHollow) {
    FillAndStroke(cr, kWhite, color, kOutlineWidth);
  } else {
    const double share = style == MarkerStyle::kPale ? kBehindShare : 1;
    FillWithHalo(cr, Paler(color, share), 2 * kWhiteRim);
  }
}

Color Paler(Color color, double share) {
  const auto mix = [share](unsigned char c) {
    return static_cast<unsigned char>(std::lround(255 - share * (255 - c)));
  };
  return {mix(color.r), mix(color.g), mix(color.b)};
}

}  // namespace regrasp::render
