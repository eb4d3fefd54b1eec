#include "sim/actuation/torque_squeeze.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {
namespace {

/// Number of bisections between a grasp force that is too large and one that is not.
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

double MostSqueeze(const HandWorld& world, double weight) {
  bool known = true;
  for (FingerIndex f{0}; f < std::ssize(world.hand().fingers); ++f) {
    for (int drive = 0; drive < world.hand().fingers[f].drives; ++drive) {
      known = known && std::isfinite(world.servo(f, drive).limit);
    }
  }
  return std::max((known ? kMostWeights : kMostWeightsOfUnknown) * weight, kEnough);
}

double RestSqueeze(HandWorld& world, const object::Polyhedron& solid, double scale,
                   const plan::HandState& state, const plan::FingerGrasp& grasp, double half_angle,
                   double weight, double most) {
  world.Place(state);
  const Eigen::Isometry3d& pose = state.pose;
  const Eigen::Vector3d down = -weight * (pose.linear().transpose() * world.hand().up);
  const grasp::Grasp contacts = plan::ContactsOf(grasp);
  /// Return the largest ratio of an actuator's torque to its limit.
  const auto load = [&](double squeeze) {
    const grasp::GraspForces forces = grasp::ComputeGraspForces(
        contacts, solid.wrench_frame(), half_angle, {down, Eigen::Vector3d::Zero()}, squeeze);
    double most_load = 0;
    for (std::size_t i = 0; i < grasp.size(); ++i) {
      const FingerIndex f = grasp[i].finger;
      const Eigen::VectorXd torques = world.BalancingTorques(f, pose * (scale * grasp[i].contact.p),
                                                             pose.linear() * forces.forces[i]);
      for (int drive = 0; drive < torques.size(); ++drive) {
        most_load = std::max(most_load, std::abs(torques[drive]) / world.servo(f, drive).limit);
      }
    }
    return most_load;
  };
  if (load(most) <= kTorqueShare) return most;
  double low = 0;
  double high = most;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (load(middle) <= kTorqueShare ? low : high) = middle;
  }
  return high;
}

double TorqueSqueeze(HandWorld& world, const object::Polyhedron& solid, const plan::Plan& plan,
                     int entries, double half_angle, double weight) {
  double squeeze = MostSqueeze(world, weight);
  for (const PlannedRest& rest : RestsOf(plan, entries)) {
    squeeze =
        RestSqueeze(world, solid, plan.scale, rest.state, rest.grasp, half_angle, weight, squeeze);
  }
  return squeeze;
}

}  // namespace regrasp::sim
