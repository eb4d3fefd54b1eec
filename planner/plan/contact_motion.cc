#include "planner/plan/contact_motion.h"

#include <cmath>
#include <numbers>

#include "planner/plan/tolerance.h"

namespace regrasp {

ContactMotion::ContactMotion(const Contact& from, const Contact& to)
    : from_(from), to_(to), turn_(AngleBetween(from.n, to.n)) {
  turn_direction_ = (to.n - to.n.dot(from.n) * from.n).stableNormalized();
}

Contact ContactMotion::At(double t) const {
  const Eigen::Vector3d normal =
      std::cos(t * turn_) * from_.n + std::sin(t * turn_) * turn_direction_;
  return {(1 - t) * from_.p + t * to_.p, normal.normalized(), t < 1 ? from_.face : to_.face};
}

Grasp GraspAt(const GraspMotion& motion, double t) {
  Grasp grasp;
  grasp.reserve(motion.size());
  for (const ContactMotion& contact : motion) grasp.push_back(contact.At(t));
  return grasp;
}

std::optional<std::string> FindMotionFault(const Object& object, const Contact& from,
                                           const Contact& to) {
  const double tolerance = kPointTolerance * object.diameter();
  if (from.face == to.face) {
    if (object.ContainsSegment(from.face, from.p, to.p, tolerance)) return std::nullopt;
    return "leaves face " + std::to_string(from.face);
  }
  const std::string faces =
      "from face " + std::to_string(from.face) + " to face " + std::to_string(to.face);
  if (!((from.p - to.p).norm() <= tolerance)) {
    return "moves " + faces + " without turning at a point that both contain";
  }
  if (AngleBetween(from.n, to.n) > std::numbers::pi - kNormalTolerance) {
    return "turns " + faces + ", whose normals are opposite";
  }
  return std::nullopt;
}

}  // namespace regrasp
