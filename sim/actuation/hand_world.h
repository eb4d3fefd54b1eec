#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "sim/actuation/hand_engine.h"
#include "sim/actuation/hand_scene.h"

struct mjModel_;

namespace regrasp::sim {

/// HandEngine in MuJoCo: the hand's own model and the object's true surface.
///
/// The fingertips are spheres or the model's collision geometry (TipShapesOf). They touch the
/// object's true surface (BallContact, FindContacts), with friction. Contacts, cones, servo gains
/// and joint friction are those of HandPhysics; without torsion_m there is no torsional friction.
/// Links pass through each other and the object; ExecutionMonitor checks that they do not. Joints
/// of no finger stay at their reference positions.
class HandWorld final : public HandEngine {
 public:
  /// @throws InputError  if the hand's model cannot be simulated; as TipShapesOf.
  HandWorld(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
            const HandWorldOptions& options);
  ~HandWorld() override;

  /// Return the model of the engine, derived servos included.
  [[nodiscard]] const mjModel_& model() const;
  /// Return the names of the model's actuators, in its order; an unnamed one gets its number.
  [[nodiscard]] std::vector<std::string> control_names() const;
  /// Return the controls of the actuators in the last step.
  [[nodiscard]] std::vector<double> controls() const;
  /// @param controls  controls of all actuators, in the model's order, until they are set again.
  void SetControls(const std::vector<double>& controls);
  /// Return the names of all joints of the hand's model, in its order.
  /// Joints of no finger are included.
  [[nodiscard]] std::vector<std::string> joint_names() const;
  /// Return the angles of all joints of the hand's model, radians.
  [[nodiscard]] std::vector<double> joint_angles() const;

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
