#pragma once

#include <Eigen/Core>
#include <span>

namespace regrasp::render {

/// A pinhole camera: right, up and back are its axes, back pointing away from what it sees.
struct Camera {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns right, up, back
  double tan_half_height = 1;                          ///< of the field of view
  int width = 1;
  int height = 1;

  /// Pixel coordinates, x to the right and y down from the top left corner.
  [[nodiscard]] Eigen::Vector2d Project(const Eigen::Vector3d& point) const;
  /// How many pixels a unit of length spans at `point`, across the line of sight.
  [[nodiscard]] double PixelsPerUnit(const Eigen::Vector3d& point) const;
  /// Distance along the line of sight of the image's centre.
  [[nodiscard]] double Depth(const Eigen::Vector3d& point) const;
};

/// Parts of the image's height that stay free of the scene.
struct Margins {
  double side = 0.05;
  double top = 0.05;
  double bottom = 0.11;
};

/// Axes of a camera that looks along −`back` with z (or y, where back is along z) up.
[[nodiscard]] Eigen::Matrix3d CameraAxes(const Eigen::Vector3d& back);

/// The nearest camera with these axes and this field of view that has all points inside the
/// margins.
///
/// In camera axes a point (x, y, z) is inside iff |x − cx| ≤ t (d − z), likewise for y, d the
/// camera's place along its back axis: the smallest d and the centre follow from the extremes of
/// ±x + t z, without iteration.
[[nodiscard]] Camera FitCamera(const Eigen::Matrix3d& axes, double tan_half_height, int width,
                               int height, const Margins& margins,
                               std::span<const Eigen::Vector3d> points);

}  // namespace regrasp::render
