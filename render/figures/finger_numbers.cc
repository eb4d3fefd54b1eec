#include "render/figures/finger_numbers.h"

#include "render/figures/panel_text.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/palette.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

/// A name nearer than this to what it belongs to needs no line, in radii.
constexpr double kBeside = 3.2;
constexpr double kLeaderWidth = 0.4;   ///< points
constexpr double kLeaderHalo = 0.8;    ///< on either side
constexpr double kLeaderStart = 0.75;  ///< from the name's centre, in radii
constexpr double kLeaderEnd = 3.6;     ///< from the contact, beside its marker, points

void DrawLeader(cairo_t* cr, const Vector2d& name, const Vector2d& owner) {
  const Vector2d way = owner - name;
  if (way.norm() < kBeside * kNumberRadius) return;
  const Vector2d from = name + kLeaderStart * kNumberRadius * way.normalized();
  const Vector2d to = owner - kLeaderEnd * way.normalized();
  SetColor(cr, kWhite);
  StrokeLine(cr, from, to, kLeaderWidth + 2 * kLeaderHalo);
  SetColor(cr, kInk);
  StrokeLine(cr, from, to, kLeaderWidth);
}

}  // namespace

std::vector<Vector2d> DrawNumbers(cairo_t* cr, std::span<const std::string> names,
                                  std::span<const LabelAnchor> anchors,
                                  std::span<const Obstacle> obstacles, const Vector2d& panel) {
  std::vector<Vector2d> centres = PlaceLabels(
      anchors, obstacles, kNumberRadius, static_cast<int>(panel.x()), static_cast<int>(panel.y()));
  for (std::size_t i = 0; i < names.size(); ++i) DrawLeader(cr, centres[i], anchors[i].Owner());
  for (std::size_t i = 0; i < names.size(); ++i) DrawMark(cr, names[i], centres[i]);
  return centres;
}

}  // namespace regrasp::render
