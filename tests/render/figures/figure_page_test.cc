#include "render/figures/figure_page.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "render/figures/panel_sheet.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {
namespace finger_marker_test {

using Eigen::Vector2d;

constexpr int kSide = 40;         ///< side of the image, points
constexpr int kPixels = 8;        ///< pixels per point
constexpr int kShapes = 5;        ///< number of shapes before they repeat
constexpr double kLeastArea = 6;  ///< minimum visible area of a marker, square points
/// Minimum visible area of a hollow marker's outline of width 0.9 points, square points.
constexpr double kLeastOutline = 10;

/// Convert a distance on an object of 100 mm in a column of 85 mm to points.
double PointsOf(double mm) { return mm / 100 * kColumnWidth; }

/// Return the visible area in the finger's own colour, square points.
double AreaOf(FingerIndex finger, const std::vector<FingerMarker>& markers) {
  const CairoSurface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, kSide * kPixels, kSide * kPixels));
  const CairoContext context(cairo_create(surface.get()));
  SetColor(context.get(), kWhite);
  cairo_paint(context.get());
  cairo_scale(context.get(), kPixels, kPixels);
  for (const FingerMarker& marker : markers) DrawFingerMarker(context.get(), marker);
  cairo_surface_flush(surface.get());
  const auto* pixels =
      reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface.get()));
  const Color color = FingerColor(finger);
  const std::uint32_t wanted = (color.r << 16) | (color.g << 8) | color.b;
  int count = 0;
  for (int i = 0; i < kSide * kPixels * kSide * kPixels; ++i) {
    if ((pixels[i] & 0xffffffU) == wanted) ++count;
  }
  return static_cast<double>(count) / (kPixels * kPixels);
}

std::vector<FingerMarker> SideBySide(int first, int second, double distance, bool ring) {
  const Vector2d middle(kSide / 2.0, kSide / 2.0);
  return {{FingerIndex(first), middle},
          {FingerIndex(second), middle + Vector2d(distance, 0), MarkerStyle::kFilled, ring}};
}

TEST(FingerMarkerTest, OverlappingMarkersAreAllVisible) {
  int checked = 0;
  for (const double mm : {0.0, 0.1, 1.0}) {
    for (int first = 0; first < kShapes; ++first) {
      for (int second = 0; second < kShapes; ++second) {
        if (first == second) continue;
        for (const bool ring : {false, true}) {
          auto markers = SideBySide(first, second, PointsOf(mm), ring);
          // Negative control: the lower marker is almost hidden.
          if (mm < 1) {
            EXPECT_LT(AreaOf(FingerIndex(first), markers), kLeastArea);
          }
          EnlargeCovered(markers);
          EXPECT_GT(AreaOf(FingerIndex(first), markers), kLeastArea) << first << second << mm;
          EXPECT_GT(AreaOf(FingerIndex(second), markers), kLeastArea) << first << second << mm;
          ++checked;
        }
      }
    }
  }
  EXPECT_EQ(checked, 3 * kShapes * (kShapes - 1) * 2);
}

TEST(FingerMarkerTest, ThreeOnEachOtherAreNested) {
  std::vector<FingerMarker> markers = SideBySide(0, 1, 0, false);
  markers.push_back(markers.back());
  markers.back().finger = FingerIndex(2);
  EnlargeCovered(markers);
  for (int finger = 0; finger < 3; ++finger) {
    EXPECT_GT(AreaOf(FingerIndex(finger), markers), kLeastArea) << finger;
  }
  EXPECT_EQ(markers.back().radius, kMarkerRadius);
}

TEST(FingerMarkerTest, AReleasedFingerIsVisibleBelowAndAboveItsReplacement) {
  for (const bool below : {false, true}) {
    std::vector<FingerMarker> markers = SideBySide(0, 1, 0, /*ring=*/below);
    markers[below ? 0 : 1].style = MarkerStyle::kHollow;
    EnlargeCovered(markers);
    for (int i = 0; i < 2; ++i) {
      const bool hollow = markers[i].style == MarkerStyle::kHollow;
      EXPECT_GT(AreaOf(FingerIndex(i), markers), hollow ? kLeastOutline : kLeastArea) << i << below;
    }
  }
}

TEST(FingerMarkerTest, OnesThatAreLessCoveredGrowLess) {
  double before = std::numeric_limits<double>::infinity();
  for (const double share : {0.0, 0.3, 0.6, 0.9}) {
    std::vector<FingerMarker> markers = SideBySide(0, 1, share * kMarkerRadius, /*ring=*/true);
    EnlargeCovered(markers);
    EXPECT_LT(markers[0].radius, before) << share;
    before = markers[0].radius;
  }
}

TEST(FingerMarkerTest, ThoseThatAreApartKeepTheirSize) {
  for (const bool ring : {false, true}) {
    std::vector<FingerMarker> markers = SideBySide(0, 1, 2.5 * kMarkerRadius, ring);
    EnlargeCovered(markers);
    for (const FingerMarker& marker : markers) EXPECT_EQ(marker.radius, kMarkerRadius);
  }
}

}  // namespace finger_marker_test
}  // namespace regrasp::render
