#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace regrasp::render {

/// What a label belongs to, in pixels: it is best placed next to `anchor` on the side of
/// `direction` (not necessarily unit; zero where any side is as good).
struct LabelAnchor {
  Eigen::Vector2d anchor;
  Eigen::Vector2d direction;
};

/// Something that labels should not cover: all points within `radius` of the segment ab.
struct Obstacle {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
  double radius = 0;
  double weight = 1;  ///< how bad it is to cover it
};

/// Centres of round labels of `label_radius` pixels that lie in the image, near their anchors, and
/// cover neither obstacles nor each other as far as possible.
///
/// Each label takes the cheapest of a fan of places around its anchor, in turn, until none
/// improves.
[[nodiscard]] std::vector<Eigen::Vector2d> PlaceLabels(std::span<const LabelAnchor> anchors,
                                                       std::span<const Obstacle> obstacles,
                                                       double label_radius, int width, int height);

}  // namespace regrasp::render
