#include "planner/object/rotation.h"

namespace regrasp::object {

// Eigen's templates for these three take seconds to compile in each file that uses them.

Eigen::AngleAxisd RotationInBody(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  return Eigen::AngleAxisd(from.transpose() * to);
}

Eigen::AngleAxisd RotationInWorld(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  return Eigen::AngleAxisd(to * from.transpose());
}

Eigen::Quaterniond AligningRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

}  // namespace regrasp::object
