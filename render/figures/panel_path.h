#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "render/figures/panel_view.h"
#include "render/figures/plan_figure.h"

namespace regrasp::render {

/// The path of a moved finger as a panel shows it, points.
struct PanelPath {
  std::vector<Eigen::Vector2d> points;  ///< from the start to the contact
  struct Tick {
    Eigen::Vector2d at;
    Eigen::Vector2d across;  ///< unit
  };
  std::vector<Tick> ticks;
};

/// The path beside the border, `distance` outside the material. At a vertex it goes through the
/// middle between the two edges' normals. Where notches are narrower than the distance it leaves
/// out what would go backwards. Ticks are waypoints, as many as print keeps apart.
[[nodiscard]] PanelPath PathBeside(std::span<const BorderPoint> path, const PanelView& view,
                                   double distance);

/// Ticks are at least this far apart and from the ends of the path, points.
inline constexpr double kPathTickGap = 6;

}  // namespace regrasp::render
