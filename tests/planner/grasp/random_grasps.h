#pragma once

#include <random>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp {

/// Random grasps of bodies that tests need no mesh for. Seeded; the same seed gives the same
/// grasps.
class RandomGrasps {
 public:
  explicit RandomGrasps(unsigned seed) : engine_(seed) {}

  /// Contacts on the unit sphere (circle), normals inward up to `tilt`.
  Grasp OnBall(int count, int dimension, double tilt = 0.3);

  /// Contacts on the faces of the box (square) [-1, 1]^d.
  Grasp OnBox(int count, int dimension);

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int Index(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
  Eigen::Vector3d Direction(int dimension);
  Eigen::Matrix3d Rotation(int dimension);

 private:
  std::mt19937_64 engine_;
};

/// The frame of the ball, and near enough of the box.
[[nodiscard]] inline WrenchFrame UnitFrame(int dimension) {
  return {Eigen::Vector3d::Zero(), 1, dimension};
}

}  // namespace regrasp
