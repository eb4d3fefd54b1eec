#pragma once

#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// One force per finger of the world, newtons in S on the object; zero for those that do not push.
using HandForces = std::vector<Eigen::Vector3d>;

/// Forces with which `fingers` hold the object against its weight and `load_S` together, at the
/// contacts as measured, with the full squeeze and the largest margin in their cones; the best
/// effort where there are none.
/// @param load_S  about the centroid, besides the weight.
[[nodiscard]] HandForces PlanHandForces(const ReplayWorld& world,
                                        const std::vector<FingerIndex>& fingers,
                                        const grasp::Wrench& load_S, double half_angle);

/// The forces that the fingers push with now.
[[nodiscard]] HandForces CurrentForces(const ReplayWorld& world);

/// Sets forces on the straight line between two: mixtures of balanced forces are balanced.
void MixForces(ReplayWorld& world, const HandForces& from, const HandForces& to, double share);

}  // namespace regrasp::sim
