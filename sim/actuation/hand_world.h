#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/collision/shape_contact.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/actuation/drive_servo.h"
#include "sim/actuation/hand_links.h"
#include "sim/actuation/joint_couplings.h"
#include "sim/scene/engine.h"
#include "sim/scene/settings.h"

struct mjModel_;

namespace regrasp::sim {

/// Options of the world of a hand.
struct HandWorldOptions {
  double mu = 0;
  double mass_kg = 0;
  double gravity_m_s2 = 9.81;  ///< gravity, opposite to the hand's up direction
  double force_factor = 1;     ///< factor on the model's limits of all actuators
  HandPhysics physics = {};
  /// Errors of the hand's joint sensors, by finger: measured minus true angles of the independent
  /// joints, radians. Empty: no errors.
  std::vector<kinematics::JointConfiguration> joint_offsets = {};
  TipShape tip = TipShape::kBall;
};

/// Contact between a fingertip and the object.
struct TipTouch {
  /// point of the surface nearest to the fingertip
  Eigen::Vector3d point_O = Eigen::Vector3d::Zero();
  Eigen::Vector3d inward_O = Eigen::Vector3d::Zero();
  /// distance; negative: the fingertip penetrates the surface
  double gap = std::numeric_limits<double>::infinity();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< force on the object, newtons
  /// speed of the fingertip along the surface, m/s
  Eigen::Vector3d sliding_O = Eigen::Vector3d::Zero();
};

/// A hand's own model in MuJoCo with a fixed palm, and a free object that only fingertips hold.
///
/// The fingertips are spheres or the model's collision geometry (TipShapesOf). They touch the
/// object's true surface (BallContact, FindContacts), with friction. Contacts, cones, servo gains
/// and joint friction are those of HandPhysics; without torsion_m there is no torsional friction.
/// Links pass through each other and the object; ExecutionMonitor checks that they do not. Joints
/// of no finger stay at their reference positions. All quantities are in the palm's frame, metres,
/// newtons, seconds; O is the object's frame (its file's axes and origin, in metres).
class HandWorld {
 public:
  /// The state that determines the simulation, except loads and whether the object is pinned.
  struct State {
    EngineState engine;
    std::vector<double> controls;
  };

  /// @throws InputError  if the hand's model cannot be simulated; as TipShapesOf.
  HandWorld(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
            const HandWorldOptions& options);
  ~HandWorld();
  HandWorld(const HandWorld&) = delete;
  HandWorld& operator=(const HandWorld&) = delete;

  [[nodiscard]] const kinematics::HandModel& hand() const;
  /// Return the model of the engine, derived servos included.
  [[nodiscard]] const mjModel_& model() const;
  [[nodiscard]] double time() const;
  [[nodiscard]] double timestep() const;
  [[nodiscard]] const Eigen::Vector3d& centroid_O() const;

  /// Set the poses of hand and object, with velocities of zero.
  void Place(const plan::HandState& state);
  [[nodiscard]] plan::HandState state() const;
  [[nodiscard]] Eigen::Isometry3d object_pose() const;
  /// Return the largest absolute velocity of hand and object, m/s or rad/s.
  [[nodiscard]] double largest_speed() const;
  [[nodiscard]] kinematics::JointConfiguration configuration(FingerIndex finger) const;
  /// Return the angles of the finger's joints, coupled joints included, radians.
  [[nodiscard]] std::vector<double> joint_angles_of(FingerIndex finger) const;
  /// Return the joint configuration that the hand's sensors measure.
  [[nodiscard]] kinematics::JointConfiguration measured_configuration(FingerIndex finger) const;
  [[nodiscard]] Eigen::Vector3d tip(FingerIndex finger) const;
  /// Return the contact of a fingertip in the last step.
  /// It has no place if the surface is farther than 5 mm. The contacts of a fingertip that is not a
  /// sphere are combined: the force is their sum. Point and normal are means, weighted with the
  /// normal forces.
  [[nodiscard]] TipTouch touch(FingerIndex finger) const;
  /// Return the surface point near the fingertip sphere, in the object's frame.
  /// The sphere counts even if other geometry makes contact. The result is nullopt beyond 5 mm.
  [[nodiscard]] std::optional<collision::NearPoint> NearBall(FingerIndex finger) const;
  /// Return the surface point near a sphere of the fingertip's radius at any place.
  /// @param centre_O  centre in the object's frame.
  [[nodiscard]] std::optional<collision::NearPoint> NearSphere(
      FingerIndex finger, const Eigen::Vector3d& centre_O) const;
  [[nodiscard]] const DriveServo& servo(FingerIndex finger, int drive) const;
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
  /// Return the force of the actuator of an independent joint, over its limit; 0 without a limit.
  [[nodiscard]] double load_share(FingerIndex finger, int drive) const;
  /// Return the present torque of the actuator about the joint, N m.
  [[nodiscard]] double torque(FingerIndex finger, int drive) const;
  /// Return whether the control of the joint is at an end of its range (`ctrlrange`).
  [[nodiscard]] bool is_control_at_limit(FingerIndex finger, int drive) const;
  /// Return the limits of all independent joints, by finger.
  [[nodiscard]] std::vector<DriveLimits> limits() const;
  /// Return the largest residual of the couplings that the model has as constraints.
  [[nodiscard]] JointCouplings::Residual largest_coupling_residual() const;
  /// Return "joint ffj1, which is coupled to ffj2,".
  [[nodiscard]] std::string CouplingText(int equality) const;
  /// Return the finger of a coupling's first joint, and the index of the joint in the finger.
  /// They are not valid and −1 for a joint of no finger.
  [[nodiscard]] std::pair<FingerIndex, int> JointOfCoupling(int equality) const;
  /// Return all links of the hand, collision geometry of its fingertips included.
  [[nodiscard]] const HandLinks& links() const;
  [[nodiscard]] TipShape tip_shape() const;
  /// Return the torques of the independent joints that balance a contact force.
  /// They balance the weight of the links, too.
  /// @param force  force of the fingertip on the object.
  [[nodiscard]] Eigen::VectorXd BalancingTorques(FingerIndex finger, const Eigen::Vector3d& at,
                                                 const Eigen::Vector3d& force) const;
  /// Set the target of the servos, as a measured joint configuration, and additional torques.
  /// The command assumes the nominal gains of the actuators, without HandPhysics::gain_factor.
  void Command(FingerIndex finger, const kinematics::JointConfiguration& target,
               const Eigen::VectorXd& torques);
  /// Set a force and a torque about the centroid on the object, in addition to its weight.
  void SetLoad(const Eigen::Vector3d& force, const Eigen::Vector3d& torque);

  /// Set whether the object is fixed at its present pose.
  void PinObject(bool on);

  /// Advance the simulation by one time step.
  /// @throws UnstableError  if the simulation becomes unstable.
  void Step();

  [[nodiscard]] State Save() const;
  /// Restore a state, without loads. The simulation after it is bit-identical, whatever precedes.
  void Restore(const State& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::sim
