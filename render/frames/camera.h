#pragma once

#include <Eigen/Core>
#include <span>
#include <variant>
#include <vector>

namespace regrasp::render {

enum class Projection { kPerspective, kOrthographic };

/// A camera with the axes right, up and back. It looks along −back.
struct Camera {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns right, up, back
  Projection projection = Projection::kPerspective;
  /// Half the height of the visible area: a length for an orthographic camera, otherwise per unit
  /// of depth (the tangent of half the field of view).
  double half_height = 1;
  int width = 1;
  int height = 1;

  /// Project a point to pixel coordinates, x to the right and y down from the top left corner.
  [[nodiscard]] Eigen::Vector2d Project(const Eigen::Vector3d& point) const;
  /// Return the number of pixels per unit of length at `point`, perpendicular to the line of sight.
  [[nodiscard]] double PixelsPerUnit(const Eigen::Vector3d& point) const;
  /// Return the distance of a point along the optical axis.
  [[nodiscard]] double Depth(const Eigen::Vector3d& point) const;
  /// Return the unit vector from a point towards the eye.
  [[nodiscard]] Eigen::Vector3d ToEye(const Eigen::Vector3d& point) const;
};

/// Empty margins of an image, per image height.
struct Margins {
  double side, top, bottom;
};

/// Return the axes of a camera that looks along −`back`, with z up, or y up if `back` is parallel
/// to z.
[[nodiscard]] Eigen::Matrix3d CameraAxes(const Eigen::Vector3d& back);

/// Tangent of half the vertical field of view of a perspective camera. It is small, so that
/// parallel edges look parallel.
inline constexpr double kTanHalfHeight = 0.15;

/// Compute the nearest perspective camera, or the smallest orthographic one, that has all points
/// inside the margins.
///
/// For a perspective camera the solution is in closed form. In camera axes a point (x, y, z) is
/// inside if and only if |x − cx| ≤ t (d − z), and the same holds for y. Here d is the position of
/// the camera along its back axis and t the slope of the border. The smallest d and the centre
/// follow from the extrema of ±x + t z.
[[nodiscard]] Camera FitCamera(const Eigen::Matrix3d& axes, Projection projection, int width,
                               int height, const Margins& margins,
                               std::span<const Eigen::Vector3d> points);

/// Crop the image symmetrically to the points and their margins.
/// @param camera   result of FitCamera for the same points and margins.
/// @param narrowest, lowest  minimum width and height, pixels.
/// @returns a camera of even width and height, at most the original size.
[[nodiscard]] Camera Crop(const Camera& camera, const Margins& margins,
                          std::span<const Eigen::Vector3d> points, int narrowest, int lowest);

}  // namespace regrasp::render
