#pragma once

#include <Eigen/Geometry>

namespace regrasp::object {

/// Return the rotation from the orientation `from` to `to`, expressed in the axes of `from`.
/// It is from⁻¹ · to, with an angle in [0, π].
/// @param from, to  rotation matrices, 3 × 3, in the same frame.
[[nodiscard]] Eigen::AngleAxisd RotationInBody(const Eigen::Matrix3d& from,
                                               const Eigen::Matrix3d& to);

/// Return the rotation from the orientation `from` to `to`, expressed in the frame of both.
/// It is to · from⁻¹, with an angle in [0, π] equal to that of RotationInBody up to rounding.
/// @param from, to  rotation matrices, 3 × 3, in the same frame.
[[nodiscard]] Eigen::AngleAxisd RotationInWorld(const Eigen::Matrix3d& from,
                                                const Eigen::Matrix3d& to);

/// Return the smallest rotation that aligns the direction of `from` with that of `to`.
/// For opposite directions the axis is one of those perpendicular to them.
/// @param from, to  vectors of any length above 0.
[[nodiscard]] Eigen::Quaterniond AligningRotation(const Eigen::Vector3d& from,
                                                  const Eigen::Vector3d& to);

/// Return the pose at a share of the motion between two poses: the translation is linear, and the
/// rotation is the smallest one at constant rate.
/// @param share  from 0 (`from`) to 1 (`to`).
[[nodiscard]] Eigen::Isometry3d PoseBetween(const Eigen::Isometry3d& from,
                                            const Eigen::Isometry3d& to, double share);

}  // namespace regrasp::object
