#pragma once

#include <Eigen/Core>

namespace regrasp::object {

/// Reference point of torques and the length that divides them, so that wrenches have one unit.
///
/// A force f at p is the wrench (f, (p − origin) × f / radius). Every tolerance, grasp quality and
/// disturbance test of the project uses this frame: `origin` is the object's centroid, `radius`
/// half its diameter. In the plane (`dimension` 2), forces are in x and y and the torque is about
/// z.
struct WrenchFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double radius = 1;
  int dimension = 3;
};

}  // namespace regrasp::object
