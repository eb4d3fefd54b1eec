#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/plan/plan.h"

namespace regrasp::render {

/// Return an angle to a tenth of a degree, "36.7°", without decimals if they are zero.
[[nodiscard]] std::string AngleText(double radians);

/// Return the longest length of the form 1, 2 or 5 times a power of ten up to `limit` (> 0).
[[nodiscard]] double RoundLength(double limit);

/// Return the name of a finger, or its number if it has none.
[[nodiscard]] std::string FingerLabel(FingerIndex finger, std::span<const std::string> names);

/// Return a title of a plan entry, for example "hold: fingers 0, 1, 2, 3", "hold: index, thumb",
/// "switch: place 4, release 0" or "align: move 1, 3".
/// @param entry  index of the entry: 0 the initial grasp, k the k-th step.
/// @param names  names of fingers by index; other fingers have their number.
[[nodiscard]] std::string EntryTitle(const plan::Plan& plan, plan::EntryIndex entry,
                                     std::span<const std::string> names = {});

/// Return the caption of a frame on one line.
///
/// Examples: "hold: fingers 0, 1, 2, 3" for entry 0, "step 1/3 · switch: place 4, release 0", "step
/// 2/3 · align: move 1 by 12 mm, 3 by 8 mm along the surface".
/// @param entry  index of the entry: 0 the initial grasp, k the k-th step.
/// @param names  names of fingers by index; other fingers have their number.
[[nodiscard]] std::string FrameCaption(const plan::Plan& plan, plan::EntryIndex entry,
                                       std::span<const std::string> names = {});

/// Return the z component of the cross product, positive if b is to the left of a.
[[nodiscard]] inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Return the distance of p from the segment ab, which may be a point.
[[nodiscard]] inline double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                              const Eigen::Vector2d& b) {
  const Eigen::Vector2d segment = b - a;
  const double square = segment.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(segment) / square, 0.0, 1.0) : 0;
  return (p - a - t * segment).norm();
}

/// Preferred position of a label, pixels.
struct LabelAnchor {
  Eigen::Vector2d anchor;
  Eigen::Vector2d direction;
  /// Point that the label names; nullopt: the anchor.
  std::optional<Eigen::Vector2d> owner = std::nullopt;

  [[nodiscard]] const Eigen::Vector2d& Owner() const { return owner ? *owner : anchor; }
};

/// An area that labels should not cover: all points within `radius` of the segment ab.
struct Obstacle {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
  double radius = 0;
  double weight = 1;  ///< relative cost of covering it
};

/// Compute centres of round labels that are inside the image and near their anchors.
///
/// Labels avoid obstacles and each other if possible. The candidates of a label are two fans of
/// positions, around its anchor and around its owner. Labels move to their cheapest candidate in
/// turn, for a fixed number of rounds. A label is nearer to its own owner than to any other owner,
/// unless two owners coincide.
/// @param label_radius   radius of every label, pixels.
/// @param width, height  size of the image, pixels.
/// @returns one centre per anchor, pixels.
[[nodiscard]] std::vector<Eigen::Vector2d> PlaceLabels(std::span<const LabelAnchor> anchors,
                                                       std::span<const Obstacle> obstacles,
                                                       double label_radius, int width, int height);

}  // namespace regrasp::render
