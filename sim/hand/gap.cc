#include "sim/hand/gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;

/// Largest number of steps, after which nothing is proved. Most pairs take ten; some with a gap
/// close to the limit take thousands.
constexpr int kMostSteps = 20'000;

// Number of steps for gaps in messages.
constexpr int kMeasureSteps = 2'000;
constexpr double kMeasured = 1e-3;
constexpr double kFreeing = 0.01;
constexpr double kFinestWay = 1e-6;  // metres
constexpr double kLongestWay = 10;

const Vector3d& FarthestAlong(const std::vector<Vector3d>& points, const Vector3d& direction) {
  const Vector3d* farthest = &points.front();
  double most = farthest->dot(direction);
  for (const Vector3d& point : points) {
    const double along = point.dot(direction);
    if (along <= most) continue;
    most = along;
    farthest = &point;
  }
  return *farthest;
}

/// Point of the difference of two hulls, as a weighted mean of its corners.
class MeanOfCorners {
 public:
  MeanOfCorners(const Vector3d& a, const Vector3d& b) : corners_{{a - b, a, 1}}, mean_(a - b) {}

  [[nodiscard]] const Vector3d& mean() const { return mean_; }

  /// Return the corresponding point of the first hull.
  [[nodiscard]] Vector3d InFirst() const {
    Vector3d point = Vector3d::Zero();
    for (const Weighted& held : corners_) point += held.weight * held.of_first;
    return point;
  }

  /// Move weight from the farthest corner along the mean to the corner of two points.
  /// Moves as much as brings the mean nearer to the origin.
  /// @returns whether it moved any.
  bool Exchange(const Vector3d& a, const Vector3d& b) {
    const Vector3d corner = a - b;
    const auto worst = std::ranges::max_element(
        corners_, {}, [&](const Weighted& held) { return held.corner.dot(mean_); });
    const Vector3d along = corner - worst->corner;
    const double square = along.squaredNorm();
    if (square == 0) return false;
    const double share = std::clamp(-mean_.dot(along) / square, 0.0, worst->weight);
    if (share == 0) return false;
    worst->weight -= share;
    if (worst->weight == 0) corners_.erase(worst);
    const auto same = std::ranges::find(corners_, corner, &Weighted::corner);
    if (same != corners_.end()) {
      same->weight += share;
    } else {
      corners_.push_back({corner, a, share});
    }
    mean_ += share * along;
    return true;
  }

 private:
  struct Weighted {
    Vector3d corner;
    Vector3d of_first;
    double weight;
  };
  std::vector<Weighted> corners_;
  Vector3d mean_;
};

Nearness Measure(const ConvexBody& a, const ConvexBody& b) {
  MeanOfCorners between(a.points.front(), b.points.front());
  for (int step = 0; step < kMeasureSteps; ++step) {
    const Vector3d& mean = between.mean();
    const Vector3d& in_a = FarthestAlong(a.points, -mean);
    const Vector3d& in_b = FarthestAlong(b.points, mean);
    if ((in_a - in_b).dot(mean) >= (1 - kMeasured) * mean.squaredNorm()) break;
    if (!between.Exchange(in_a, in_b)) break;
  }
  const double length = between.mean().norm();
  const double gap = length - a.radius - b.radius;
  const Vector3d from_a = length > 0 ? Vector3d(between.mean() / -length) : Vector3d::Zero();
  return {gap, between.InFirst() + (a.radius + gap / 2) * from_a};
}

}  // namespace

ConvexBody MakeConvexBody(std::vector<Vector3d> points, double radius) {
  ConvexBody solid{std::move(points), radius, Vector3d::Zero(), 0};
  for (const Vector3d& point : solid.points) {
    solid.centre += point;
    solid.box.extend(point);
  }
  solid.centre /= static_cast<double>(solid.points.size());
  double square = 0;
  for (const Vector3d& point : solid.points) {
    square = std::max(square, (point - solid.centre).squaredNorm());
  }
  solid.reach = std::sqrt(square) + radius;
  return solid;
}

ConvexBody Moved(const Eigen::Isometry3d& pose, ConvexBody solid) {
  for (Vector3d& point : solid.points) point = pose * point;
  return MakeConvexBody(std::move(solid.points), solid.radius);
}

bool HaveGap(const ConvexBody& a, const ConvexBody& b, double gap) {
  if ((a.centre - b.centre).norm() - a.reach - b.reach > gap) return true;
  const double needed = gap + a.radius + b.radius;
  if (needed < 0 || a.box.exteriorDistance(b.box) > needed) return true;
  MeanOfCorners between(a.points.front(), b.points.front());
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector3d& mean = between.mean();
    const double length = mean.norm();
    if (length <= needed) return false;
    // All points of the difference of the hulls are beyond this plane.
    const Vector3d& in_a = FarthestAlong(a.points, -mean);
    const Vector3d& in_b = FarthestAlong(b.points, mean);
    if ((in_a - in_b).dot(mean) > needed * length) return true;
    if (!between.Exchange(in_a, in_b)) return false;
  }
  return false;
}

Nearness NearestOf(const ConvexBody& solid, std::span<const ConvexBody> others) {
  Nearness nearest = {std::numeric_limits<double>::infinity(), solid.centre};
  for (const ConvexBody& other : others) {
    if ((solid.centre - other.centre).norm() - solid.reach - other.reach > nearest.gap) continue;
    const Nearness found = Measure(solid, other);
    if (found.gap < nearest.gap) nearest = found;
  }
  return nearest;
}

double FreeingDistance(const ConvexBody& solid, std::span<const ConvexBody> others,
                       std::span<const Vector3d> directions) {
  const auto is_free = [&](const Vector3d& way) {
    const ConvexBody moved = Moved(Eigen::Isometry3d(Eigen::Translation3d(way)), solid);
    return std::ranges::all_of(others,
                               [&](const ConvexBody& other) { return HaveGap(moved, other, 0); });
  };
  double shortest = kLongestWay;
  for (const Vector3d& direction : directions) {
    double held = 0;
    double free = kFinestWay;
    while (free < shortest && !is_free(free * direction)) {
      held = free;
      free *= 2;
    }
    if (free >= shortest && !is_free(shortest * direction)) continue;
    free = std::min(free, shortest);
    while (free - held > std::max(kFinestWay, kFreeing * free)) {
      const double middle = (held + free) / 2;
      (is_free(middle * direction) ? free : held) = middle;
    }
    shortest = free;
  }
  return shortest;
}

}  // namespace regrasp::sim
