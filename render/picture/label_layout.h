#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace regrasp::render {

/// The z component of the cross product: positive where b is to the left of a.
[[nodiscard]] inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// How far p is from the segment from a to b, which may be a point.
[[nodiscard]] inline double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                              const Eigen::Vector2d& b) {
  const Eigen::Vector2d segment = b - a;
  const double square = segment.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(segment) / square, 0.0, 1.0) : 0;
  return (p - a - t * segment).norm();
}

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
