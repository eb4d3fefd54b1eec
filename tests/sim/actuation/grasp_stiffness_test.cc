#include "sim/actuation/grasp_stiffness.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "planner/grasp/grasp_forces.h"
#include "sim/actuation/hand_control.h"
#include "sim/actuation/hand_world.h"
#include "tests/sim/actuation/held_in_hand.h"

namespace regrasp::sim {
namespace grasp_stiffness_test {

using Eigen::Vector3d;

/// Grasp of the fixture, at the present state of a world.
class GraspStiffnessTest : public HeldInHand {
 protected:
  [[nodiscard]] double radius() const { return kScale * solid().diameter() / 2; }

  /// @param squeeze  grasp force, newtons; at least the weight's.
  [[nodiscard]] std::vector<StiffFinger> Fingers(const HandWorld& world, double grasp_force,
                                                 double stiffness_factor = 1) const {
    const Eigen::Isometry3d pose = world.object_pose();
    const Vector3d down = -kMass * 9.81 * (pose.linear().transpose() * world.hand().up);
    const grasp::GraspForces forces =
        grasp::ComputeGraspForces(plan::ContactsOf(plan_.initial), solid().wrench_frame(),
                                  std::atan(kMu), {down, Vector3d::Zero()}, grasp_force);
    std::vector<StiffFinger> fingers;
    for (std::size_t i = 0; i < plan_.initial.size(); ++i) {
      const plan::FingerContact& held = plan_.initial[i];
      const kinematics::Finger& chain = world.hand().fingers[held.finger];
      Eigen::VectorXd stiffness(chain.drives);
      for (int drive = 0; drive < chain.drives; ++drive) {
        stiffness[drive] = stiffness_factor * world.servo(held.finger, drive).stiffness;
      }
      fingers.push_back({&chain, world.configuration(held.finger), stiffness,
                         pose * (kScale * held.contact.p), pose.linear() * held.contact.n,
                         pose.linear() * forces.forces[i]});
    }
    return fingers;
  }

  [[nodiscard]] GraspStiffness Stiffness(const HandWorld& world, double grasp_force) const {
    return ComputeGraspStiffness(Fingers(world, grasp_force),
                                 world.object_pose() * world.centroid_O(), radius());
  }
};

TEST_F(GraspStiffnessTest, IsSymmetricWithoutForcesAndLinearInStiffnessAndForces) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  world.Place(plan_.hand->initial);
  const Vector3d centroid = world.object_pose() * world.centroid_O();
  std::vector<StiffFinger> loaded = Fingers(world, 5);
  std::vector<StiffFinger> twice = Fingers(world, 5, 2);
  std::vector<StiffFinger> unloaded = loaded;
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    twice[i].force *= 2;
    unloaded[i].force.setZero();
  }
  const GraspStiffness with = ComputeGraspStiffness(loaded, centroid, radius());
  const GraspStiffness without = ComputeGraspStiffness(unloaded, centroid, radius());
  EXPECT_LT((without - without.transpose()).norm(), 1e-9 * without.norm());
  EXPECT_GT(SmallestStiffness(without), 0);
  EXPECT_LT((ComputeGraspStiffness(twice, centroid, radius()) - 2 * with).norm(),
            1e-6 * with.norm());
  EXPECT_GT((with - without).norm(), 1e-2 * without.norm());
}

TEST_F(GraspStiffnessTest, FallsAsTheGraspForceGrowsUntilTheGraspIsUnstable) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  world.Place(plan_.hand->initial);
  const double low = SmallestStiffness(Stiffness(world, 5));
  const double high = SmallestStiffness(Stiffness(world, 40));
  EXPECT_GT(low, high);
  EXPECT_LT(SmallestStiffness(Stiffness(world, 1000)), 0);
}

TEST_F(GraspStiffnessTest, IsThatOfTheSimulation) {
  HandWorld world(hand_, solid(), kScale, {.mu = kMu, .mass_kg = kMass});
  world.Place(plan_.hand->initial);
  constexpr double kGraspForce = 8;
  HandControl control(world, solid(), kScale,
                      {std::atan(kMu), kMass * 9.81, {.feedback = PoseFeedback::kNone}});
  control.SetFeedback(false);
  Hold hold = {{}, kGraspForce};
  for (const plan::FingerContact& held : plan_.initial) {
    control.Attach(held.finger);
    hold.fingers.push_back(held.finger);
  }
  control.SetHolding({hold, hold});
  for (int i = 0; i < 1500; ++i) control.Step();
  // The controls stay as they are from here on.
  const auto rest = [&](const Vector3d& force) {
    const HandWorld::State state = world.Save();
    world.SetLoad(force, Vector3d::Zero());
    for (int i = 0; i < 1000; ++i) world.Step();
    const Vector3d centre = world.object_pose() * world.centroid_O();
    world.Restore(state);
    return centre;
  };
  const GraspStiffness stiffness = Stiffness(world, kGraspForce);
  const Vector3d unloaded = rest(Vector3d::Zero());
  constexpr double kForce = 0.1;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d moved = rest(kForce * Vector3d::Unit(axis)) - unloaded;
    Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();
    wrench[axis] = kForce;
    const Vector3d expected = stiffness.fullPivLu().solve(wrench).head(3);
    // Contacts of the simulation are slightly soft.
    EXPECT_LT((moved - expected).norm(), 0.2 * expected.norm()) << axis;
  }
}

}  // namespace grasp_stiffness_test
}  // namespace regrasp::sim
