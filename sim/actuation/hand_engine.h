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
#include "planner/kinematics/hand_model.h"
#include "planner/plan/plan.h"
#include "sim/actuation/drive_servo.h"
#include "sim/actuation/hand_links.h"
#include "sim/actuation/joint_couplings.h"
#include "sim/scene/engine.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

struct HandScene;

/// Options of the world of a hand, in any engine.
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

/// A hand with a fixed palm, and a free object that only fingertips hold, in a physics engine.
///
/// Controller, sensors and monitor of a hand replay know only this interface. All quantities are in
/// the palm's frame, metres, newtons, seconds; O is the object's frame (its file's axes and origin,
/// in metres).
class HandEngine {
 public:
  /// The state that determines the simulation, except loads and whether the object is pinned.
  struct State {
    EngineState engine;
    std::vector<double> controls;
  };

  virtual ~HandEngine();
  HandEngine(const HandEngine&) = delete;
  HandEngine& operator=(const HandEngine&) = delete;

  [[nodiscard]] const kinematics::HandModel& hand() const;
  [[nodiscard]] virtual double time() const = 0;
  [[nodiscard]] double timestep() const;
  [[nodiscard]] const Eigen::Vector3d& centroid_O() const;
  /// Return all links of the hand, collision geometry of its fingertips included.
  [[nodiscard]] const HandLinks& links() const;
  [[nodiscard]] TipShape tip_shape() const;

  /// Set the poses of hand and object, with velocities of zero.
  virtual void Place(const plan::HandState& state) = 0;
  [[nodiscard]] virtual plan::HandState state() const = 0;
  [[nodiscard]] virtual Eigen::Isometry3d object_pose() const = 0;
  /// Return the largest absolute velocity of hand and object, m/s or rad/s.
  [[nodiscard]] virtual double largest_speed() const = 0;
  [[nodiscard]] virtual kinematics::JointConfiguration configuration(FingerIndex finger) const = 0;
  /// Return the angles of the finger's joints, coupled joints included, radians.
  [[nodiscard]] virtual std::vector<double> joint_angles_of(FingerIndex finger) const = 0;
  /// Return the joint configuration that the hand's sensors measure.
  [[nodiscard]] kinematics::JointConfiguration measured_configuration(FingerIndex finger) const;
  [[nodiscard]] virtual Eigen::Vector3d tip(FingerIndex finger) const = 0;
  /// Return the contact of a fingertip in the last step.
  /// It has no place if the surface is farther than 5 mm. The contacts of a fingertip that is not a
  /// sphere are combined: the force is their sum. Point and normal are means, weighted with the
  /// normal forces.
  [[nodiscard]] virtual TipTouch touch(FingerIndex finger) const = 0;
  /// Return the surface point near the fingertip sphere, in the object's frame.
  /// The sphere counts even if other geometry makes contact. The result is nullopt beyond 5 mm.
  [[nodiscard]] virtual std::optional<collision::NearPoint> NearBall(FingerIndex finger) const = 0;
  /// Return the surface point near a sphere of the fingertip's radius at any place.
  /// @param centre_O  centre in the object's frame.
  [[nodiscard]] std::optional<collision::NearPoint> NearSphere(
      FingerIndex finger, const Eigen::Vector3d& centre_O) const;

  [[nodiscard]] const DriveServo& servo(FingerIndex finger, int drive) const;
  /// Return the force of the actuator of an independent joint, over its limit; 0 without a limit.
  [[nodiscard]] double load_share(FingerIndex finger, int drive) const;
  /// Return the present torque of the actuator about the joint, N m.
  [[nodiscard]] virtual double torque(FingerIndex finger, int drive) const = 0;
  /// Return whether the control of the joint is at an end of its range (`ctrlrange`).
  [[nodiscard]] virtual bool is_control_at_limit(FingerIndex finger, int drive) const = 0;
  /// Return the limits of all independent joints, by finger.
  [[nodiscard]] std::vector<DriveLimits> limits() const;
  /// Return the largest residual of the couplings that the model has as constraints.
  [[nodiscard]] virtual JointCouplings::Residual largest_coupling_residual() const = 0;
  /// Return "joint ffj1, which is coupled to ffj2,".
  [[nodiscard]] std::string CouplingText(int equality) const;
  /// Return the finger of a coupling's first joint, and the index of the joint in the finger.
  /// They are not valid and −1 for a joint of no finger.
  [[nodiscard]] std::pair<FingerIndex, int> JointOfCoupling(int equality) const;

  /// Return the torques of the independent joints that balance a contact force.
  /// They balance the weight of the links, too.
  /// @param force  force of the fingertip on the object.
  [[nodiscard]] virtual Eigen::VectorXd BalancingTorques(FingerIndex finger,
                                                         const Eigen::Vector3d& at,
                                                         const Eigen::Vector3d& force) const = 0;
  /// Set the target of the servos, as a measured joint configuration, and additional torques.
  /// The command assumes the nominal gains of the actuators, without HandPhysics::gain_factor.
  virtual void Command(FingerIndex finger, const kinematics::JointConfiguration& target,
                       const Eigen::VectorXd& torques) = 0;
  /// Set a force and a torque about the centroid on the object, in addition to its weight.
  virtual void SetLoad(const Eigen::Vector3d& force, const Eigen::Vector3d& torque) = 0;
  /// Set whether the object is fixed at its present pose.
  virtual void PinObject(bool on) = 0;

  /// Advance the simulation by one time step.
  /// @throws UnstableError  if the simulation becomes unstable.
  virtual void Step() = 0;

  [[nodiscard]] virtual State Save() const = 0;
  /// Restore a state, without loads. The simulation after it is bit-identical, whatever precedes.
  virtual void Restore(const State& state) = 0;

 protected:
  explicit HandEngine(std::unique_ptr<HandScene> scene);

  [[nodiscard]] HandScene& scene() { return *scene_; }
  [[nodiscard]] const HandScene& scene() const { return *scene_; }

 private:
  std::unique_ptr<HandScene> scene_;
};

}  // namespace regrasp::sim
