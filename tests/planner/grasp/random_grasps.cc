#include "random_grasps.h"

#include <Eigen/Geometry>
#include <numbers>

namespace regrasp {

Eigen::Vector3d RandomGrasps::Direction(int dimension) {
  std::normal_distribution<double> normal;
  Eigen::Vector3d direction;
  do {
    direction = {normal(engine_), normal(engine_), dimension == 3 ? normal(engine_) : 0};
  } while (direction.norm() < 1e-3);
  return direction.normalized();
}

Eigen::Matrix3d RandomGrasps::Rotation(int dimension) {
  const Eigen::Vector3d axis = dimension == 3 ? Direction(3) : Eigen::Vector3d::UnitZ();
  return Eigen::AngleAxisd(Uniform(0, 2 * std::numbers::pi), axis).toRotationMatrix();
}

Grasp RandomGrasps::OnBall(int count, int dimension, double tilt) {
  Grasp grasp;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p = Direction(dimension);
    grasp.push_back({p, (-p + tilt * Uniform(0, 1) * Direction(dimension)).normalized()});
  }
  return grasp;
}

Grasp RandomGrasps::OnBox(int count, int dimension) {
  Grasp grasp;
  for (int i = 0; i < count; ++i) {
    const int axis = Index(dimension);
    const double side = Index(2) == 0 ? -1 : 1;
    Contact contact;
    contact.p = {Uniform(-1, 1), Uniform(-1, 1), dimension == 3 ? Uniform(-1, 1) : 0};
    contact.p[axis] = side;
    contact.n[axis] = -side;
    grasp.push_back(contact);
  }
  return grasp;
}

}  // namespace regrasp
