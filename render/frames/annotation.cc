#include "render/frames/annotation.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "planner/base/quantity_text.h"
#include "render/picture/cairo_image.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/label_layout.h"
#include "render/picture/plane_geometry.h"
#include "render/picture/round_length.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;

// Shares of the image's height, and pixels.
constexpr double kFontSize = 0.024;
constexpr double kSmallestFont = 7;
constexpr double kMargin = 0.032;
constexpr double kLongestBar = 0.20;

// In font sizes.
constexpr double kNumberSize = 1.2;
constexpr double kLabelRadius = 0.66;
constexpr double kHalo = 0.32;
constexpr double kLeaderWidth = 0.08;
constexpr double kRingGap = 0.36;
constexpr double kRingWidth = 0.14;

/// A number this near to its finger needs no line to it, in radii of a label.
constexpr double kBeside = 2.6;

/// Labels should not cover these; to cover a cone is a lesser evil.
constexpr double kFingerWeight = 1;
constexpr double kConeWeight = 0.25;
constexpr double kTextWeight = 3;
/// The friction cone counts as a strip of this share of its length.
constexpr double kConeStrip = 0.3;

/// Numbers and rings are a darker shade of their finger's colour: thin strokes look paler.
constexpr double kShade = 0.82;

Color NumberColor(Color color) {
  const auto shade = [](int channel) { return static_cast<unsigned char>(kShade * channel); };
  return {shade(color.r), shade(color.g), shade(color.b)};
}

void DrawCentred(cairo_t* cr, const std::string& text, const Vector2d& centre, Color color,
                 double halo) {
  const Vector2d begin = CentredText(cr, text, centre);
  cairo_move_to(cr, begin.x(), begin.y());
  cairo_text_path(cr, text.c_str());
  FillWithHalo(cr, color, halo);
}

/// A ring just outside the ball, dark within white, so that it shows on any ground.
void DrawRing(cairo_t* cr, const Camera& camera, const FingerGlyph& glyph, double font) {
  const Vector2d centre = camera.Project(glyph.ball);
  const double radius = glyph.ball_radius * camera.PixelsPerUnit(glyph.ball) + kRingGap * font;
  for (const bool white : {true, false}) {
    SetCircle(cr, centre, radius);
    Stroke(cr, white ? kWhite : NumberColor(glyph.color), (white ? 2.2 : 1) * kRingWidth * font);
  }
}

std::vector<Obstacle> ObstaclesOf(const Camera& camera, std::span<const FingerGlyph> fingers) {
  std::vector<Obstacle> obstacles;
  for (const FingerGlyph& glyph : fingers) {
    const double pixels = camera.PixelsPerUnit(glyph.ball);
    const Vector2d ball = camera.Project(glyph.ball);
    obstacles.push_back({ball, ball, glyph.ball_radius * pixels, kFingerWeight});
    obstacles.push_back(
        {ball, camera.Project(glyph.end), glyph.ball_radius / 2 * pixels, kFingerWeight});
    obstacles.push_back({camera.Project(glyph.contact),
                         camera.Project(glyph.contact - glyph.outward * kConeLength),
                         kConeStrip * kConeLength * pixels, kConeWeight});
    for (std::size_t i = 1; i < glyph.path.size(); ++i) {
      obstacles.push_back(
          {camera.Project(glyph.path[i - 1]), camera.Project(glyph.path[i]), 0, kFingerWeight});
    }
  }
  return obstacles;
}

/// A line from a number to its finger's ball, where it does not stand beside the finger.
void DrawLeader(cairo_t* cr, const Camera& camera, const FingerGlyph& glyph, const Vector2d& number,
                double font) {
  const Vector2d ball = camera.Project(glyph.ball);
  if (DistanceToSegment(number, ball, camera.Project(glyph.end)) < kBeside * kLabelRadius * font) {
    return;
  }
  const Vector2d along = (ball - number).normalized();
  const Vector2d from = number + kLabelRadius * font * along;
  for (const bool white : {true, false}) {
    cairo_move_to(cr, from.x(), from.y());
    cairo_line_to(cr, ball.x(), ball.y());
    Stroke(cr, white ? kWhite : NumberColor(glyph.color), (white ? 2.4 : 1) * kLeaderWidth * font);
  }
}

void DrawNumbers(cairo_t* cr, const Camera& camera, std::span<const FingerGlyph> fingers,
                 std::vector<Obstacle> text, double font) {
  std::vector<LabelAnchor> anchors;
  for (const FingerGlyph& glyph : fingers) {
    const Vector2d anchor = camera.Project(glyph.end);
    anchors.push_back({anchor, anchor - camera.Project(glyph.contact), camera.Project(glyph.ball)});
  }
  std::vector<Obstacle> obstacles = ObstaclesOf(camera, fingers);
  obstacles.insert(obstacles.end(), text.begin(), text.end());
  const std::vector<Vector2d> centres =
      PlaceLabels(anchors, obstacles, kLabelRadius * font, camera.width, camera.height);
  SelectFont(cr, kNumberSize * font, /*bold=*/true);
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    DrawLeader(cr, camera, fingers[i], centres[i], font);
  }
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    DrawCentred(cr, std::to_string(fingers[i].finger), centres[i], NumberColor(fingers[i].color),
                kHalo * font);
  }
}

/// Writes the caption, in a smaller font where it would be too wide, and returns what it covers.
std::vector<Obstacle> DrawCaption(cairo_t* cr, const Camera& camera, const std::string& caption,
                                  double font) {
  if (caption.empty()) return {};
  const double margin = kMargin * camera.height;
  const double space = camera.width * (1 - kLongestBar) - 3 * margin;
  SelectFont(cr, font, /*bold=*/false);
  const double size = font * std::min(1.0, space / TextWidth(cr, caption));
  if (size < kSmallestFont) return {};
  SelectFont(cr, size, /*bold=*/false);
  const double base = camera.height - margin;
  cairo_move_to(cr, margin, base);
  cairo_text_path(cr, caption.c_str());
  FillWithHalo(cr, kInk, kHalo * font);
  const double middle = base - size / 3;
  return {{{margin, middle}, {margin + TextWidth(cr, caption), middle}, size / 2, kTextWeight}};
}

std::vector<Obstacle> DrawScaleBar(cairo_t* cr, const Camera& camera, double metres_per_unit,
                                   double font) {
  if (font < kSmallestFont) return {};
  const double pixels_per_metre = camera.PixelsPerUnit(Eigen::Vector3d::Zero()) / metres_per_unit;
  const double metres = RoundLength(kLongestBar * camera.width / pixels_per_metre);
  const double length = metres * pixels_per_metre;
  const double margin = kMargin * camera.height;
  const double y = camera.height - margin;
  const double right = camera.width - margin;
  const double left = right - length;
  const double tick = font / 4;
  for (const double x : {left, right}) {
    cairo_move_to(cr, x, y - tick);
    cairo_line_to(cr, x, y + tick);
  }
  cairo_move_to(cr, left, y);
  cairo_line_to(cr, right, y);
  Stroke(cr, kInk, std::max(1.0, font / 10));
  SelectFont(cr, font, /*bold=*/false);
  DrawCentred(cr, FormatLength(metres), {(left + right) / 2, y - 0.8 * font}, kInk, kHalo * font);
  return {{{left, y - font / 2}, {right, y - font / 2}, font, kTextWeight}};
}

}  // namespace

Image Annotate(const Image& image, const Camera& camera, std::span<const FingerGlyph> fingers,
               const std::string& caption, double metres_per_unit) {
  const CairoImage page(image);
  cairo_t* cr = page.context();
  const double font = kFontSize * image.height;
  for (const FingerGlyph& glyph : fingers) {
    if (glyph.role == plan::FingerRole::kPlaced) DrawRing(cr, camera, glyph, font);
  }
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  std::vector<Obstacle> text = DrawCaption(cr, camera, caption, font);
  for (const Obstacle& bar : DrawScaleBar(cr, camera, metres_per_unit, font)) text.push_back(bar);
  DrawNumbers(cr, camera, fingers, text, std::max(font, kSmallestFont));
  return page.ToImage();
}

}  // namespace regrasp::render
