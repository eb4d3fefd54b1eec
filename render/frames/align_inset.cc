#include "render/frames/align_inset.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/base/number.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// In font sizes.
constexpr double kRadius = 3.6;
constexpr double kSpace = 1.1;   ///< that an inset takes, of its radius
constexpr double kTravel = 3.6;  ///< of the magnified path
constexpr double kDisc = 0.8;    ///< of a finger's place
constexpr double kArrow = 0.22;
constexpr double kInsetRim = 0.09;
constexpr double kText = 0.8;

constexpr double kMostMagnified = 200;
constexpr double kPale = 0.35;
constexpr double kWeight = 3;  ///< of an inset as an obstacle

double LengthOf(const std::vector<Vector3d>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

Vector3d MiddleOf(const FingerGlyph& glyph) { return (glyph.path.front() + glyph.contact) / 2; }

/// The same camera with a longer lens, moved aside so that a point is seen at `place`.
Camera Magnify(Camera camera, double magnification, const Vector3d& point, const Vector2d& place) {
  camera.half_height /= magnification;
  const Vector2d off = (place - camera.Project(point)) / camera.PixelsPerUnit(point);
  camera.position -= camera.axes.leftCols<2>() * Vector2d(off.x(), -off.y());
  return camera;
}

}  // namespace

std::vector<AlignInset> PlaceInsets(const Camera& camera, std::span<const FingerGlyph> fingers,
                                    std::span<const Obstacle> covered, const TextStyle& style) {
  std::vector<AlignInset> insets;
  if (style.font < kSmallestFont) return insets;
  std::vector<LabelAnchor> anchors;
  for (const FingerGlyph& glyph : fingers) {
    const double length = LengthOf(glyph.path);
    if (!FirstLeg(glyph) || !(length < 2 * glyph.ball_radius)) continue;
    const double pixels = length * camera.PixelsPerUnit(glyph.contact);
    const double magnification = std::min(kTravel * style.font / pixels, kMostMagnified);
    const Vector2d ball = camera.Project(glyph.ball);
    AlignInset& inset = insets.emplace_back();
    inset.glyph = glyph;
    inset.ball = ball;
    inset.radius = kRadius * style.font;
    inset.magnification = magnification;
    anchors.push_back({ball, ball - camera.Project(Vector3d::Zero())});
  }
  std::vector<Obstacle> obstacles = ObstaclesOf(camera, fingers);
  obstacles.insert(obstacles.end(), covered.begin(), covered.end());
  const std::vector<Vector2d> centres =
      PlaceLabels(anchors, obstacles, kSpace * kRadius * style.font, camera.width, camera.height);
  for (std::size_t i = 0; i < insets.size(); ++i) {
    insets[i].centre = centres[i];
    insets[i].camera =
        Magnify(camera, insets[i].magnification, MiddleOf(insets[i].glyph), centres[i]);
  }
  return insets;
}

std::vector<Obstacle> DrawInset(const CairoImage& page, const AlignInset& inset, const Image& body,
                                const TextStyle& style) {
  cairo_t* cr = page.context();
  const FingerGlyph& glyph = inset.glyph;
  const Ground& ground = style.ground;
  const double font = style.font;
  const Camera& camera = inset.camera;
  SetColor(cr, ground.ink);
  StrokeLine(cr, inset.centre, inset.ball, kInsetRim * font);
  cairo_save(cr);
  SetCircle(cr, inset.centre, inset.radius);
  cairo_clip(cr);
  const CairoImage background(body);
  cairo_set_source_surface(cr, background.surface(), 0, 0);
  cairo_paint(cr);
  std::vector<Vector2d> path;
  for (const Vector3d& p : glyph.path) path.push_back(camera.Project(p));
  SetCircle(cr, path.front(), kDisc * font);
  Fill(cr, glyph.color, kPale);
  SetCircle(cr, path.back(), kDisc * font);
  Fill(cr, glyph.color);
  DrawArrow(cr, path, kArrow * font, ground.ink, ground.halo);
  DrawDot(cr, path.front(), kArrow * font);
  SelectFont(cr, kText * font, /*bold=*/false);
  constexpr int kDigits = 2;
  const std::string text = "× " + FormatPlain(inset.magnification, kDigits);
  const Vector2d low(0, 0.72 * inset.radius);
  const Vector2d at = CentredText(cr, text, inset.centre + low);
  cairo_move_to(cr, at.x(), at.y());
  cairo_text_path(cr, text.c_str());
  FillWithHalo(cr, ground.ink, 0.3 * font, ground.halo);
  cairo_restore(cr);
  SetCircle(cr, inset.centre, inset.radius);
  Stroke(cr, ground.ink, kInsetRim * font);
  return {{inset.centre, inset.centre, inset.radius, kWeight}};
}

}  // namespace regrasp::render
