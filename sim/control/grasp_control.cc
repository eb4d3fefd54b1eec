#include "sim/control/grasp_control.h"

namespace regrasp::sim {

using Eigen::Vector3d;

HandForces PlanHandForces(const ReplayWorld& world, const std::vector<FingerIndex>& fingers,
                          const grasp::Wrench& load_S, double half_angle) {
  HandForces forces(world.fingers().size(), Vector3d::Zero());
  if (fingers.empty()) return forces;
  const Eigen::Matrix3d R_SB = world.X_SB().linear();
  grasp::Grasp contacts;
  for (const FingerIndex f : fingers) {
    const grasp::Contact& planned = world.fingers()[f].contact;
    contacts.push_back(
        {world.ContactPoint_B(f), planned.n, planned.face, world.settings().torsion_m});
  }
  const grasp::Wrench load_B{R_SB.transpose() * (world.weight_S() + load_S.force),
                             R_SB.transpose() * load_S.torque_over_radius};
  const grasp::GraspForces planned = grasp::ComputeGraspForces(
      contacts, world.frame_B(), half_angle, load_B, world.settings().squeeze_N);
  for (std::size_t i = 0; i < fingers.size(); ++i) forces[fingers[i]] = R_SB * planned.forces[i];
  return forces;
}

HandForces CurrentForces(const ReplayWorld& world) {
  HandForces forces;
  for (const WorldFinger& finger : world.fingers()) forces.push_back(finger.force_S);
  return forces;
}

void MixForces(ReplayWorld& world, const HandForces& from, const HandForces& to, double share) {
  for (std::size_t f = 0; f < from.size(); ++f) {
    world.fingers()[f].force_S = (1 - share) * from[f] + share * to[f];
  }
}

}  // namespace regrasp::sim
