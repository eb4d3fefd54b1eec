#pragma once

#include <Eigen/Core>
#include <span>
#include <variant>
#include <vector>

namespace regrasp::render {

enum class Projection { kPerspective, kOrthographic };

/// A camera: right, up and back are its axes, back pointing away from what it sees.
struct Camera {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns right, up, back
  Projection projection = Projection::kPerspective;
  /// Half of what it sees from the bottom to the top: a length if orthographic, otherwise per
  /// length of depth (the tangent of half the field of view).
  double half_height = 1;
  int width = 1;
  int height = 1;

  /// Pixel coordinates, x to the right and y down from the top left corner.
  [[nodiscard]] Eigen::Vector2d Project(const Eigen::Vector3d& point) const;
  /// How many pixels a unit of length spans at `point`, across the line of sight.
  [[nodiscard]] double PixelsPerUnit(const Eigen::Vector3d& point) const;
  /// Distance along the line of sight of the image's centre.
  [[nodiscard]] double Depth(const Eigen::Vector3d& point) const;
  /// The unit vector from `point` towards the eye.
  [[nodiscard]] Eigen::Vector3d ToEye(const Eigen::Vector3d& point) const;
};

/// Shares of the image's height that stay free of the scene.
struct Margins {
  double side, top, bottom;
};

/// Axes of a camera that looks along −`back` with z (or y, where back is along z) up.
[[nodiscard]] Eigen::Matrix3d CameraAxes(const Eigen::Vector3d& back);

/// The tangent of half of the vertical field of view in perspective: a long lens, so that parallel
/// edges look so.
inline constexpr double kTanHalfHeight = 0.15;

/// The nearest camera with these axes and this field of view, or the orthographic one of the
/// smallest half-height, that has all points inside the margins.
///
/// In perspective: in camera axes a point (x, y, z) is inside iff |x − cx| ≤ t (d − z), likewise
/// for y, d the camera's place along its back axis: the smallest d and the centre follow from the
/// extremes of ±x + t z, without iteration.
[[nodiscard]] Camera FitCamera(const Eigen::Matrix3d& axes, Projection projection, int width,
                               int height, const Margins& margins,
                               std::span<const Eigen::Vector3d> points);

/// The same picture without what is beyond the margins of the points on both sides alike.
/// @param camera   by FitCamera, of these points and margins.
/// @param narrowest, lowest  pixels that stay.
/// @returns a camera of even width and height, no larger than before.
[[nodiscard]] Camera Crop(const Camera& camera, const Margins& margins,
                          std::span<const Eigen::Vector3d> points, int narrowest, int lowest);

}  // namespace regrasp::render
