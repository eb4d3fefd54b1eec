#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "sim/actuation/hand_engine.h"

namespace regrasp::sim {

/// Check that ODE can simulate the physics of a replay.
/// @throws InputError  for pyramidal cones, MuJoCo's default contacts, and torsional friction.
void CheckOdePhysics(const HandPhysics& physics);

/// HandEngine in the Open Dynamics Engine (ODE), independent of MuJoCo's dynamics and contacts.
///
/// Every link is a body in maximal coordinates, with its inertia at its centre of mass. Joints
/// are hard constraints. Armature, damping, springs and servos of a joint are one implicit row
/// (JointDrive). Contacts are hard, and friction cones are circular (BoxInCircle, KeepsCone): each
/// step is solved again until the friction of every contact obeys its cone, and every actuator its
/// force limit. ODE's direct solver is used. Coupled joints are exact; their actuator moves the
/// joint that the others follow (LinkCoupling).
///
/// A time step of the replay is two steps of ODE with the same controls. After each the links are
/// placed again from their joint angles, so joints do not drift. The velocities of the links are
/// kept, so that centrifugal and Coriolis forces are those of ODE.
///
/// It shares with HandWorld the numbers of the hand's model (HandScene), and the search for places
/// at which fingertips touch the object (TipSurface).
class OdeHand final : public HandEngine {
 public:
  /// @throws InputError  if the hand cannot be simulated in ODE: several joints of a body, coupled
  ///     joints that are not successive, forces of tendons; as CheckOdePhysics.
  OdeHand(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
          const HandWorldOptions& options);
  ~OdeHand() override;

  [[nodiscard]] double time() const override;
  void Place(const plan::HandState& state) override;
  [[nodiscard]] plan::HandState state() const override;
  [[nodiscard]] Eigen::Isometry3d object_pose() const override;
  [[nodiscard]] double largest_speed() const override;
  [[nodiscard]] kinematics::JointConfiguration configuration(FingerIndex finger) const override;
  [[nodiscard]] std::vector<double> joint_angles_of(FingerIndex finger) const override;
  [[nodiscard]] Eigen::Vector3d tip(FingerIndex finger) const override;
  [[nodiscard]] TipTouch touch(FingerIndex finger) const override;
  [[nodiscard]] std::optional<collision::NearPoint> NearBall(FingerIndex finger) const override;
  [[nodiscard]] double torque(FingerIndex finger, int drive) const override;
  [[nodiscard]] bool is_control_at_limit(FingerIndex finger, int drive) const override;
  [[nodiscard]] JointCouplings::Residual largest_coupling_residual() const override;
  [[nodiscard]] Eigen::VectorXd BalancingTorques(FingerIndex finger, const Eigen::Vector3d& at,
                                                 const Eigen::Vector3d& force) const override;
  void Command(FingerIndex finger, const kinematics::JointConfiguration& target,
               const Eigen::VectorXd& torques) override;
  void SetLoad(const Eigen::Vector3d& force, const Eigen::Vector3d& torque) override;
  void PinObject(bool on) override;
  void Step() override;
  [[nodiscard]] State Save() const override;
  void Restore(const State& state) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::sim
