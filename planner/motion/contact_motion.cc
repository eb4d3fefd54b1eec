#include "planner/motion/contact_motion.h"

#include <cmath>

#include "planner/grasp/required_friction_angle.h"

namespace regrasp::motion {

ContactMotion::ContactMotion(const grasp::Contact& from, const grasp::Contact& to)
    : from_(from), to_(to), turn_(grasp::AngleBetween(from.n, to.n)) {
  turn_direction_ = (to.n - to.n.dot(from.n) * from.n).stableNormalized();
}

grasp::Contact ContactMotion::At(double t) const {
  const Eigen::Vector3d normal =
      std::cos(t * turn_) * from_.n + std::sin(t * turn_) * turn_direction_;
  return {(1 - t) * from_.p + t * to_.p, normal.normalized(), t < 1 ? from_.face : to_.face,
          from_.torsion};
}

grasp::Grasp GraspAt(const GraspMotion& motion, double t) {
  grasp::Grasp grasp;
  grasp.reserve(motion.size());
  for (const ContactMotion& contact : motion) grasp.push_back(contact.At(t));
  return grasp;
}

}  // namespace regrasp::motion
