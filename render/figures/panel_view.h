#pragma once

#include <Eigen/Geometry>
#include <span>

#include "planner/object/polygon.h"
#include "render/figures/plan_figure.h"

namespace regrasp::render {

/// The object's plane on a panel of a figure: object units to points, y up to y down.
struct PanelView {
  double width = 0;                                  ///< points
  double height = 0;                                 ///< points
  double scale = 1;                                  ///< points per unit
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< what the panel's middle shows

  [[nodiscard]] Eigen::Vector2d ToPanel(const Eigen::Vector2d& p) const {
    return {width / 2 + scale * (p.x() - centre.x()), height / 2 - scale * (p.y() - centre.y())};
  }
  /// A direction on the panel, of the same length.
  [[nodiscard]] static Eigen::Vector2d ToPanelDirection(const Eigen::Vector2d& d) {
    return {d.x(), -d.y()};
  }
};

/// Space around the object for markers, arrows and numbers, points.
inline constexpr double kPanelMargin = 18;

/// Focus points farther than this from the polygon's bounding box, in diameters, are off the page:
/// the object would become too small.
inline constexpr double kFocusOnPage = 0.35;

/// One view for all figures of a plan: it shows the polygon and the focus points that are not too
/// far, as large as `width` points and a height of at most `width` times kTallestPanel allow. The
/// height is what is needed.
[[nodiscard]] PanelView FitView(const object::Polygon& polygon,
                                std::span<const StepDiagram> diagrams, double width);

inline constexpr double kTallestPanel = 1.25;

}  // namespace regrasp::render
