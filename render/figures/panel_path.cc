#include "render/figures/panel_path.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

/// Normals whose sum is shorter than this are opposite but for rounding: any direction will do.
constexpr double kOpposite = 1e-9;

/// The waypoints on the panel, those at one place as one.
std::vector<BorderPoint> Joined(std::span<const BorderPoint> path, const PanelView& view) {
  std::vector<BorderPoint> joined;
  const Vector2d* last = nullptr;
  for (const BorderPoint& point : path) {
    const Vector2d outward = PanelView::ToPanelDirection(point.outward);
    if (last != nullptr && *last == point.p) {
      joined.back().outward += outward;
    } else {
      joined.push_back({view.ToPanel(point.p), outward});
    }
    last = &point.p;
  }
  for (BorderPoint& point : joined) {
    if (point.outward.norm() > kOpposite) point.outward.normalize();
  }
  return joined;
}

}  // namespace

PanelPath PathBeside(std::span<const BorderPoint> path, const PanelView& view, double distance) {
  const std::vector<BorderPoint> joined = Joined(path, view);
  std::vector<std::size_t> kept;
  const auto beside = [&](std::size_t i) -> Vector2d {
    return joined[i].p + distance * joined[i].outward;
  };
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const auto goes_backwards = [&](std::size_t from) {
      return (beside(i) - beside(from)).dot(joined[i].p - joined[from].p) <= 0;
    };
    while (kept.size() > 1 && goes_backwards(kept.back())) kept.pop_back();
    kept.push_back(i);
  }
  PanelPath result;
  for (const std::size_t i : kept) result.points.push_back(beside(i));
  for (std::size_t k = 1; k + 1 < kept.size(); ++k) {
    const Vector2d& at = result.points[k];
    const Vector2d& before = result.ticks.empty() ? result.points.front() : result.ticks.back().at;
    const bool apart =
        (at - before).norm() >= kPathTickGap && (at - result.points.back()).norm() >= kPathTickGap;
    if (apart) result.ticks.push_back({at, joined[kept[k]].outward});
  }
  return result;
}

}  // namespace regrasp::render
