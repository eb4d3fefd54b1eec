#include "sim/hand/gap.h"

#include <algorithm>
#include <cmath>

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;

/// What is not shown by then is not shown. Most pairs take ten; some that are nearly as near as is
/// asked for take thousands.
constexpr int kMostSteps = 20'000;

const Vector3d& FarthestAlong(const std::vector<Vector3d>& points, const Vector3d& direction) {
  return *std::ranges::max_element(points, {},
                                   [&](const Vector3d& point) { return point.dot(direction); });
}

/// A point of the difference of two hulls as a mean of corners of it.
class MeanOfCorners {
 public:
  explicit MeanOfCorners(const Vector3d& corner) : corners_{{corner, 1}}, mean_(corner) {}

  [[nodiscard]] const Vector3d& mean() const { return mean_; }

  /// Moves weight from the corner that is worst along the mean to `corner`, as far as that brings
  /// the mean nearer to the origin. @returns whether it did.
  bool Exchange(const Vector3d& corner) {
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
      corners_.push_back({corner, share});
    }
    mean_ += share * along;
    return true;
  }

 private:
  struct Weighted {
    Vector3d corner;
    double weight;
  };
  std::vector<Weighted> corners_;
  Vector3d mean_;
};

}  // namespace

Solid MakeSolid(std::vector<Vector3d> points, double radius) {
  Solid solid{std::move(points), radius, Vector3d::Zero(), 0};
  for (const Vector3d& point : solid.points) solid.centre += point;
  solid.centre /= static_cast<double>(solid.points.size());
  for (const Vector3d& point : solid.points) {
    solid.reach = std::max(solid.reach, (point - solid.centre).norm());
  }
  solid.reach += radius;
  return solid;
}

bool HaveGap(const Solid& a, const Solid& b, double gap) {
  if ((a.centre - b.centre).norm() - a.reach - b.reach > gap) return true;
  const double needed = gap + a.radius + b.radius;
  if (needed < 0) return true;
  MeanOfCorners between(a.points.front() - b.points.front());
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector3d& mean = between.mean();
    const double length = mean.norm();
    if (length <= needed) return false;
    // All of the difference of the hulls is beyond this plane.
    const Vector3d support = FarthestAlong(a.points, -mean) - FarthestAlong(b.points, mean);
    if (support.dot(mean) > needed * length) return true;
    if (!between.Exchange(support)) return false;
  }
  return false;
}

}  // namespace regrasp::sim
