#include "render/frames/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace regrasp::render {

namespace {

/// Distance of an orthographic camera from the centre of the scene: always outside the scene.
constexpr double kOrthographicDistance = 10;

/// Bounds of a camera's position along one image axis and of its distance, so that coordinates stay
/// within the slopes −`low` and `high` of its optical axis.
struct AxisFit {
  double high, low;
  double max_high = -std::numeric_limits<double>::infinity();
  double max_low = -std::numeric_limits<double>::infinity();

  void Add(double a, double z) {
    max_high = std::max(max_high, a + high * z);
    max_low = std::max(max_low, -a + low * z);
  }
  [[nodiscard]] double Distance() const { return (max_high + max_low) / (high + low); }
  /// Return the centre that puts the scene in the middle of the free space at distance `d`.
  [[nodiscard]] double Centre(double d) const {
    return ((max_high - high * d) + (low * d - max_low)) / 2;
  }
};

/// Slopes of the borders of the usable area, relative to half the image height.
struct Slopes {
  double side, top, bottom;
};

void FitPerspective(const Slopes& slopes, std::span<const Eigen::Vector3d> points, Camera& camera) {
  const double t = kTanHalfHeight;
  AxisFit horizontal = {t * slopes.side, t * slopes.side};
  AxisFit vertical = {t * slopes.top, t * slopes.bottom};
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = camera.axes.transpose() * point;
    horizontal.Add(p.x(), p.z());
    vertical.Add(p.y(), p.z());
  }
  const double d = std::max(horizontal.Distance(), vertical.Distance());
  camera.half_height = t;
  camera.position = camera.axes * Eigen::Vector3d(horizontal.Centre(d), vertical.Centre(d), d);
}

void FitOrthographic(const Slopes& slopes, std::span<const Eigen::Vector3d> points,
                     Camera& camera) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : points) {
    box.extend(Eigen::Vector2d((camera.axes.transpose() * point).head<2>()));
  }
  const Eigen::Vector2d size = box.sizes();
  const double half =
      std::max(size.x() / (2 * slopes.side), size.y() / (slopes.top + slopes.bottom));
  // The scene is in the middle of the free space.
  const double y = box.center().y() - half * (slopes.top - slopes.bottom) / 2;
  camera.half_height = half;
  camera.position = camera.axes * Eigen::Vector3d(box.center().x(), y, kOrthographicDistance);
}

}  // namespace

double Camera::Depth(const Eigen::Vector3d& point) const {
  return -(point - position).dot(axes.col(2));
}

Eigen::Vector3d Camera::ToEye(const Eigen::Vector3d& point) const {
  if (projection == Projection::kOrthographic) return axes.col(2);
  return (position - point).normalized();
}

double Camera::PixelsPerUnit(const Eigen::Vector3d& point) const {
  const double depth = projection == Projection::kPerspective ? Depth(point) : 1;
  return height / (2 * half_height * depth);
}

Eigen::Vector2d Camera::Project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d d = point - position;
  const double scale = PixelsPerUnit(point);
  return {width / 2.0 + scale * d.dot(axes.col(0)), height / 2.0 - scale * d.dot(axes.col(1))};
}

Eigen::Matrix3d CameraAxes(const Eigen::Vector3d& back) {
  // Above this z component, the z axis is too close to the viewing direction to define up.
  constexpr double kPole = 0.999;
  const Eigen::Vector3d up =
      std::abs(back.normalized().z()) < kPole ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d axes;
  axes.col(2) = back.normalized();
  axes.col(0) = up.cross(axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Camera FitCamera(const Eigen::Matrix3d& axes, Projection projection, int width, int height,
                 const Margins& margins, std::span<const Eigen::Vector3d> points) {
  Camera camera;
  camera.axes = axes;
  camera.projection = projection;
  camera.width = width;
  camera.height = height;
  // The side margin is relative to the height, and at most a quarter of the width.
  const double side = std::min(2 * margins.side * height / width, 0.5);
  const Slopes slopes = {static_cast<double>(width) / height * (1 - side), 1 - 2 * margins.top,
                         1 - 2 * margins.bottom};
  if (projection == Projection::kPerspective) {
    FitPerspective(slopes, points, camera);
  } else {
    FitOrthographic(slopes, points, camera);
  }
  return camera;
}

Camera Crop(const Camera& camera, const Margins& margins, std::span<const Eigen::Vector3d> points,
            int narrowest, int lowest) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : points) box.extend(camera.Project(point));
  const double side = margins.side * camera.height;
  const Eigen::Vector2d before = box.min() - Eigen::Vector2d(side, margins.top * camera.height);
  const Eigen::Vector2d after =
      Eigen::Vector2d(camera.width - side, camera.height * (1 - margins.bottom)) - box.max();
  const Eigen::Vector2d free_space = before.cwiseMin(after);
  const auto cropped = [](int size, double free_before, int least) {
    const auto half = static_cast<int>(std::ceil(size / 2.0 - std::max(free_before, 0.0)));
    return std::min(size, std::max(2 * half, least));
  };
  Camera crop = camera;
  crop.width = cropped(camera.width, free_space.x(), narrowest);
  crop.height = cropped(camera.height, free_space.y(), lowest);
  crop.half_height *= static_cast<double>(crop.height) / camera.height;
  return crop;
}

}  // namespace regrasp::render
