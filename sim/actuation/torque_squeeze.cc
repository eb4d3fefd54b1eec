#include "sim/actuation/torque_squeeze.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/plan/hand_path.h"

namespace regrasp::sim {
namespace {

/// Of the interval between a squeeze that is too much and one that is not.
constexpr int kHalvings = 10;

struct PlannedRest {
  plan::HandState state;
  plan::FingerGrasp grasp;
};

std::vector<PlannedRest> RestsOf(const plan::Plan& plan, int entries) {
  std::vector<PlannedRest> rests = {{plan.hand->initial, plan.initial}};
  for (plan::EntryIndex entry{1}; entry < entries; ++entry) {
    const plan::Step& step = plan::StepOf(plan, entry);
    PlannedRest rest = {rests.back().state, plan::GraspAfter(rests.back().grasp, step)};
    for (const plan::HandPath* path : plan::PathsOf(step)) {
      if (!path->empty()) rest.state = path->back();
    }
    rests.push_back(std::move(rest));
  }
  return rests;
}

}  // namespace

double TorqueSqueeze(HandWorld& world, const object::Polyhedron& solid, const plan::Plan& plan,
                     int entries, double half_angle, double weight) {
  /// The largest torque of an actuator over its limit.
  const auto load = [&](const PlannedRest& rest, double squeeze) {
    const Eigen::Isometry3d& pose = rest.state.pose;
    const Eigen::Vector3d down = -weight * (pose.linear().transpose() * world.hand().up);
    const grasp::GraspForces forces =
        grasp::ComputeGraspForces(plan::ContactsOf(rest.grasp), solid.wrench_frame(), half_angle,
                                  {down, Eigen::Vector3d::Zero()}, squeeze);
    double most = 0;
    for (std::size_t i = 0; i < rest.grasp.size(); ++i) {
      const FingerIndex f = rest.grasp[i].finger;
      const Eigen::VectorXd torques = world.BalancingTorques(
          f, pose * (plan.scale * rest.grasp[i].contact.p), pose.linear() * forces.forces[i]);
      for (int drive = 0; drive < torques.size(); ++drive) {
        most = std::max(most, std::abs(torques[drive]) / world.servo(f, drive).limit);
      }
    }
    return most;
  };
  double squeeze = std::max(kMostWeights * weight, kEnough);
  for (const PlannedRest& rest : RestsOf(plan, entries)) {
    world.Place(rest.state);
    if (load(rest, squeeze) <= kTorqueShare) continue;
    double low = 0;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (low + squeeze) / 2;
      (load(rest, middle) <= kTorqueShare ? low : squeeze) = middle;
    }
  }
  return squeeze;
}

}  // namespace regrasp::sim
