#include "render/frames/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace regrasp::render {

namespace {

/// Where a camera must be along one image axis and how far back, to see coordinates `a` within
/// slopes −`low` and `high` of its line of sight.
struct AxisFit {
  double high, low;
  double max_high = -std::numeric_limits<double>::infinity();
  double max_low = -std::numeric_limits<double>::infinity();

  void Add(double a, double z) {
    max_high = std::max(max_high, a + high * z);
    max_low = std::max(max_low, -a + low * z);
  }
  [[nodiscard]] double Distance() const { return (max_high + max_low) / (high + low); }
  /// The scene sits in the middle of the space that is left at distance `d`.
  [[nodiscard]] double Centre(double d) const {
    return ((max_high - high * d) + (low * d - max_low)) / 2;
  }
};

}  // namespace

double Camera::Depth(const Eigen::Vector3d& point) const {
  return -(point - position).dot(axes.col(2));
}

double Camera::PixelsPerUnit(const Eigen::Vector3d& point) const {
  return height / (2 * tan_half_height * Depth(point));
}

Eigen::Vector2d Camera::Project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d d = point - position;
  const double scale = PixelsPerUnit(point);
  return {width / 2.0 + scale * d.dot(axes.col(0)), height / 2.0 - scale * d.dot(axes.col(1))};
}

Eigen::Matrix3d CameraAxes(const Eigen::Vector3d& back) {
  // Nearer to the pole than this the z axis no longer tells which way is up.
  constexpr double kPole = 0.999;
  const Eigen::Vector3d up =
      std::abs(back.normalized().z()) < kPole ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d axes;
  axes.col(2) = back.normalized();
  axes.col(0) = up.cross(axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Camera FitCamera(const Eigen::Matrix3d& axes, double tan_half_height, int width, int height,
                 const Margins& margins, std::span<const Eigen::Vector3d> points) {
  const double t = tan_half_height;
  // The side margin is a share of the height; a narrow image gives at most a quarter of its width.
  const double side = std::min(2 * margins.side * height / width, 0.5);
  const double t_side = t * width / height * (1 - side);
  AxisFit horizontal = {t_side, t_side};
  AxisFit vertical = {t * (1 - 2 * margins.top), t * (1 - 2 * margins.bottom)};
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = axes.transpose() * point;
    horizontal.Add(p.x(), p.z());
    vertical.Add(p.y(), p.z());
  }
  const double d = std::max(horizontal.Distance(), vertical.Distance());
  Camera camera;
  camera.axes = axes;
  camera.position = axes * Eigen::Vector3d(horizontal.Centre(d), vertical.Centre(d), d);
  camera.tan_half_height = t;
  camera.width = width;
  camera.height = height;
  return camera;
}

}  // namespace regrasp::render
