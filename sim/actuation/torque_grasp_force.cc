#include "sim/actuation/torque_grasp_force.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan.h"
#include "sim/actuation/grasp_stiffness.h"

namespace regrasp::sim {
namespace {

/// Number of bisections between a grasp force that is too large and one that is not.
constexpr int kHalvings = 10;
/// The same for the force that is available for an object of any weight.
constexpr int kHalvingsOfHeavy = 50;
/// Largest measured grasp force, weights.
constexpr double kMostMeasured = 20;

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

/// A static grasp of a hand, with which forces it holds, and what resists them.
class HeldGrasp {
 public:
  HeldGrasp(HandEngine& world, const object::Polyhedron& solid, double scale,
            const plan::HandState& state, const plan::FingerGrasp& grasp, double friction_angle,
            double weight, bool may_be_supported)
      : world_(world),
        solid_(solid),
        pose_(state.pose),
        grasp_(grasp),
        contacts_(plan::ContactsOf(grasp)),
        scale_(scale),
        friction_angle_(friction_angle),
        may_be_supported_(may_be_supported) {
    load_.force = -weight * (pose_.linear().transpose() * world.hand().up);
    world.Place(state);
  }

  [[nodiscard]] grasp::GraspForces ForcesAt(double grasp_force) const {
    grasp::GraspForces forces = grasp::ComputeGraspForces(contacts_, solid_.wrench_frame(),
                                                          friction_angle_, load_, grasp_force);
    if (forces.balanced || !may_be_supported_) return forces;
    return grasp::ComputeSupportForces(contacts_, solid_.wrench_frame(), friction_angle_, load_,
                                       grasp_force);
  }

  /// Return the largest ratio of an actuator's torque to its limit.
  [[nodiscard]] double LoadAt(double grasp_force) const {
    const grasp::GraspForces forces = ForcesAt(grasp_force);
    double most = 0;
    for (std::size_t i = 0; i < grasp_.size(); ++i) {
      const FingerIndex f = grasp_[i].finger;
      const Eigen::VectorXd torques = world_.BalancingTorques(f, pose_ * (scale_ * contacts_[i].p),
                                                              pose_.linear() * forces.forces[i]);
      for (int drive = 0; drive < torques.size(); ++drive) {
        most = std::max(most, std::abs(torques[drive]) / world_.servo(f, drive).limit);
      }
    }
    return most;
  }

  /// @param share  factor on the forces.
  [[nodiscard]] double StiffnessAt(double grasp_force, double share = 1) const {
    const grasp::GraspForces forces = ForcesAt(grasp_force);
    std::vector<StiffFinger> fingers;
    for (std::size_t i = 0; i < grasp_.size(); ++i) {
      const FingerIndex f = grasp_[i].finger;
      const kinematics::Finger& chain = world_.hand().fingers[f];
      Eigen::VectorXd stiffness(chain.drives);
      for (int drive = 0; drive < chain.drives; ++drive) {
        stiffness[drive] = world_.servo(f, drive).stiffness;
      }
      fingers.push_back({&chain, world_.configuration(f), stiffness,
                         pose_ * (scale_ * contacts_[i].p), pose_.linear() * contacts_[i].n,
                         share * (pose_.linear() * forces.forces[i])});
    }
    const double radius = scale_ * solid_.diameter() / 2;
    return SmallestStiffness(ComputeGraspStiffness(fingers, pose_ * world_.centroid_O(), radius));
  }

 private:
  HandEngine& world_;
  const object::Polyhedron& solid_;
  Eigen::Isometry3d pose_;
  const plan::FingerGrasp& grasp_;
  grasp::Grasp contacts_;
  double scale_;
  double friction_angle_;
  bool may_be_supported_;
  grasp::Wrench load_;
};

/// Return the largest force up to `most` at which a condition holds that fails from some force on.
/// The result is at most `most` / 2^halvings too large.
template <typename Holds>
double LargestForce(double most, const Holds& holds, int halvings = kHalvings) {
  if (holds(most)) return most;
  double low = 0;
  double high = most;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return high;
}

}  // namespace

double LargestGraspForce(double weight) { return std::max(kMostWeights * weight, kEnough); }

double StaticGraspForce(HandEngine& world, const object::Polyhedron& solid, double scale,
                        const plan::HandState& state, const plan::FingerGrasp& grasp,
                        double friction_angle, double weight, double most, bool may_be_supported) {
  const HeldGrasp held(world, solid, scale, state, grasp, friction_angle, weight, may_be_supported);
  const double allowed = LargestForce(
      most, [&](double grasp_force) { return held.LoadAt(grasp_force) <= kTorqueShare; });
  const double unloaded = held.StiffnessAt(most, 0);
  const double stable = LargestForce(allowed, [&](double grasp_force) {
    return held.StiffnessAt(grasp_force) >= kStableShare * unloaded;
  });
  if (stable >= allowed) return allowed;
  const double required = LargestForce(allowed, [&](double grasp_force) {
    return held.ForcesAt(grasp_force).margin < kLeastMargin;
  });
  return std::max(stable, required);
}

std::optional<planning::GraspForceNeed> ComputeGraspForceNeed(
    HandEngine& world, const object::Polyhedron& solid, const plan::Plan& plan,
    plan::EntryIndex entry, double friction_angle, double weight) {
  const PlannedRest rest = RestsOf(plan, int{entry} + 1).back();
  const HeldGrasp held(world, solid, plan.scale, rest.state, rest.grasp, friction_angle, weight,
                       plan.hand->gravity_support.has_value());
  const double most = kMostMeasured * weight;
  const auto supports = [&](double grasp_force) {
    const grasp::GraspForces forces = held.ForcesAt(grasp_force);
    return forces.balanced && forces.margin >= kLeastMargin;
  };
  if (!supports(most)) return std::nullopt;
  return planning::GraspForceNeed{
      .weight = weight,
      .required = LargestForce(most, [&](double grasp_force) { return !supports(grasp_force); }),
      .available = LargestForce(
          most, [&](double grasp_force) { return held.LoadAt(grasp_force) <= kTorqueShare; },
          kHalvingsOfHeavy)};
}

std::vector<double> ComputeGraspForcesOfPlan(HandEngine& world, const object::Polyhedron& solid,
                                             const plan::Plan& plan, int entries,
                                             double friction_angle, double weight) {
  std::vector<double> grasp_forces;
  for (const PlannedRest& rest : RestsOf(plan, entries)) {
    grasp_forces.push_back(StaticGraspForce(world, solid, plan.scale, rest.state, rest.grasp,
                                            friction_angle, weight, LargestGraspForce(weight),
                                            plan.hand->gravity_support.has_value()));
  }
  return grasp_forces;
}

}  // namespace regrasp::sim
