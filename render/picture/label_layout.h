#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace regrasp::render {

/// What a label belongs to, in pixels: it is best placed next to `anchor` on the side of
/// `direction` (not necessarily unit; zero where any side is as good), and must not be nearer to
/// the owner of another label than to its own.
struct LabelAnchor {
  Eigen::Vector2d anchor;
  Eigen::Vector2d direction;
  std::optional<Eigen::Vector2d> owner = std::nullopt;  ///< the anchor where it is not given

  [[nodiscard]] const Eigen::Vector2d& Owner() const { return owner ? *owner : anchor; }
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
/// Each label takes the cheapest of two fans of places, around its anchor and around its owner, in
/// turn, until none improves. Law: a label is nearer to its own owner than to any other, unless two
/// owners are the same point.
[[nodiscard]] std::vector<Eigen::Vector2d> PlaceLabels(std::span<const LabelAnchor> anchors,
                                                       std::span<const Obstacle> obstacles,
                                                       double label_radius, int width, int height);

}  // namespace regrasp::render
