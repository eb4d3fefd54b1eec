#include "render/picture/label_layout.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace regrasp::render {

namespace {

using Eigen::Vector2d;

constexpr int kAngles = 24;
/// Distances from the anchor to the centre of the label, in label radii.
constexpr double kDistances[] = {1.15, 1.7, 2.4, 3.3, 4.5, 6, 8, 11};
constexpr double kDistanceCost = 0.35;  ///< cost per label radius of distance
constexpr double kAngleCost = 0.4;      ///< cost of the side opposite to the preferred one
constexpr double kOverlapCost = 6;      ///< cost of covering an obstacle by one label radius
constexpr double kOutsideCost = 100;
constexpr double kWrongOwnerCost = 200;
/// Largest ratio of the distances to the own and to another owner that is free of cost.
constexpr double kClearlyNearer = 0.9;
constexpr double kUnclearOwnerCost = 2;
/// Weight of other labels as obstacles, and the factor by which they are enlarged.
constexpr double kLabelWeight = 2;
constexpr double kLabelMargin = 1.1;
constexpr int kRounds = 4;

double Cover(const Vector2d& centre, double radius, const Obstacle& obstacle) {
  const double gap = DistanceToSegment(centre, obstacle.a, obstacle.b) - obstacle.radius - radius;
  return gap < 0 ? -gap / radius * obstacle.weight : 0;
}

struct Layout {
  std::span<const LabelAnchor> anchors;
  std::span<const Obstacle> obstacles;
  double radius;
  int width, height;
  std::vector<Vector2d> centres;

  [[nodiscard]] double Cost(std::size_t label, const Vector2d& centre) const {
    double cost = 0;
    for (const Obstacle& obstacle : obstacles) {
      cost += kOverlapCost * Cover(centre, radius, obstacle);
    }
    for (std::size_t other = 0; other < centres.size(); ++other) {
      if (other == label) continue;
      const Obstacle taken = {centres[other], centres[other], radius * kLabelMargin, kLabelWeight};
      cost += kOverlapCost * Cover(centre, radius, taken);
    }
    const Vector2d& own = anchors[label].Owner();
    for (const LabelAnchor& other : anchors) {
      if (other.Owner() == own) continue;
      const double share = (centre - own).norm() / (centre - other.Owner()).norm();
      if (share >= 1) cost += kWrongOwnerCost;
      if (share > kClearlyNearer) cost += kUnclearOwnerCost;
    }
    const bool inside = centre.x() >= radius && centre.x() <= width - radius &&
                        centre.y() >= radius && centre.y() <= height - radius;
    return inside ? cost : cost + kOutsideCost;
  }

  [[nodiscard]] Vector2d BestPlace(std::size_t label) const {
    const LabelAnchor& wish = anchors[label];
    const double wanted = std::atan2(wish.direction.y(), wish.direction.x());
    Vector2d best = wish.anchor;
    double best_cost = std::numeric_limits<double>::infinity();
    for (const Vector2d& middle : {wish.anchor, wish.Owner()}) {
      for (const double distance : kDistances) {
        for (int i = 0; i < kAngles; ++i) {
          const double turn = 2 * std::numbers::pi * i / kAngles;
          const double angle = wanted + turn;
          const Vector2d centre =
              middle + distance * radius * Vector2d(std::cos(angle), std::sin(angle));
          const double cost = Cost(label, centre) + kDistanceCost * distance +
                              kAngleCost * (1 - std::cos(turn)) / 2;
          if (cost < best_cost) {
            best_cost = cost;
            best = centre;
          }
        }
      }
    }
    return best;
  }
};

}  // namespace

std::vector<Vector2d> PlaceLabels(std::span<const LabelAnchor> anchors,
                                  std::span<const Obstacle> obstacles, double label_radius,
                                  int width, int height) {
  Layout layout = {anchors, obstacles, label_radius, width, height, {}};
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    layout.centres.push_back(layout.BestPlace(i));
  }
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < anchors.size(); ++i) layout.centres[i] = layout.BestPlace(i);
  }
  return layout.centres;
}

}  // namespace regrasp::render
