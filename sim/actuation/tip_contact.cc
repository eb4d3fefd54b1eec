#include "sim/actuation/tip_contact.h"

#include <algorithm>
#include <utility>

#include "planner/kinematics/model_names.h"

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;
using kinematics::VectorAt;

/// What is deeper in the object is pushed out as if it were this deep, or tips that overlap it
/// where their balls do not were thrown off, metres: five times what presses at rest.
constexpr double kDeepestContact = 3e-4;

/// Two directions at right angles to a unit vector and to each other.
std::pair<Vector3d, Vector3d> Tangents(const Vector3d& normal) {
  const Vector3d first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

}  // namespace

mjContact MakeTipContact(const collision::SurfaceContact& touching, const Eigen::Isometry3d& pose,
                         double mu) {
  mjContact contact = {};
  contact.dist = std::max(touching.gap, -kDeepestContact);
  const Vector3d normal = pose.linear() * touching.outward;
  const Vector3d at = pose * touching.point + contact.dist / 2 * normal;
  const auto [first, second] = Tangents(normal);
  std::copy_n(at.data(), 3, contact.pos);
  std::copy_n(normal.data(), 3, contact.frame);
  std::copy_n(first.data(), 3, contact.frame + 3);
  std::copy_n(second.data(), 3, contact.frame + 6);
  contact.friction[0] = contact.friction[1] = mu;
  contact.friction[2] = contact.friction[3] = contact.friction[4] = mjMINMU;
  contact.solref[0] = kTipContactTime;
  contact.solref[1] = 1;
  std::ranges::copy(kTipImpedance, contact.solimp);
  contact.dim = 3;
  contact.efc_address = -1;  // it has no force before a step
  return contact;
}

ContactSum SumTipContacts(const mjModel& model, const mjData& data, int object_geom, int tip_geom) {
  ContactSum sum;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    if (contact.geom1 != object_geom || contact.geom2 != tip_geom) continue;
    mjtNum local[6];
    mj_contactForce(&model, &data, i, local);
    // The engine gives the force on the second geom.
    for (int k = 0; k < 3; ++k) sum.force -= local[k] * VectorAt(contact.frame, k);
    const Vector3d normal = VectorAt(contact.frame, 0);
    sum.pressing += local[0];
    sum.point += local[0] * (VectorAt(contact.pos, 0) - contact.dist / 2 * normal);
    sum.normal += local[0] * normal;
  }
  return sum;
}

}  // namespace regrasp::sim
