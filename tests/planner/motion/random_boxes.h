#pragma once

#include <Eigen/Core>
#include <random>

#include "planner/grasp/contact.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::motion {

/// Random grasps of a box away from the origin; planar ones of a square.
class RandomBoxes {
 public:
  explicit RandomBoxes(int dimension) : dimension_(dimension) {}

  grasp::Grasp Draw(int count) {
    grasp::Grasp grasp;
    for (int i = 0; i < count; ++i) grasp.push_back(DrawContact());
    return grasp;
  }
  grasp::Contact DrawContact() {
    grasp::Contact contact;
    for (int axis = 0; axis < dimension_; ++axis) contact.p[axis] = uniform_(engine_);
    const int axis = std::uniform_int_distribution<int>(0, dimension_ - 1)(engine_);
    const double side = uniform_(engine_) < 0 ? -1 : 1;
    contact.p[axis] = side;
    contact.n[axis] = -side;
    contact.p += dimension_ == 3 ? Eigen::Vector3d(5, -3, 2) : Eigen::Vector3d(5, -3, 0);
    return contact;
  }
  /// Return a grasp with contacts at other points of the same sides.
  grasp::Grasp Moved(const grasp::Grasp& grasp, double reach) {
    grasp::Grasp moved = grasp;
    for (grasp::Contact& contact : moved) {
      for (int axis = 0; axis < dimension_; ++axis) {
        if (std::abs(contact.n[axis]) < 0.5) contact.p[axis] += reach * uniform_(engine_);
      }
    }
    return moved;
  }
  /// Return a number in (−1, 1).
  double Uniform() { return uniform_(engine_); }

 private:
  int dimension_;
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

inline object::WrenchFrame FrameOf(int dimension) {
  return {Eigen::Vector3d(5, -3, 0), 1.5, dimension};
}

/// Return two pairs of opposite fingers on the sides of a cube.
inline grasp::Grasp CrossedGrasp() {
  return {{Eigen::Vector3d(1, 0.1, 0), -Eigen::Vector3d::UnitX()},
          {Eigen::Vector3d(-1, 0, 0.1), Eigen::Vector3d::UnitX()},
          {Eigen::Vector3d(0, 1, -0.1), -Eigen::Vector3d::UnitY()},
          {Eigen::Vector3d(0.1, -1, 0), Eigen::Vector3d::UnitY()}};
}

inline GraspMotion MotionOf(const grasp::Grasp& from, const grasp::Grasp& to) {
  GraspMotion motion;
  for (std::size_t i = 0; i < from.size(); ++i) motion.emplace_back(from[i], to[i]);
  return motion;
}

}  // namespace regrasp::motion
