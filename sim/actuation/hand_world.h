#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/collision/ball_contact.h"
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

/// What the world of a hand is made of.
struct HandWorldOptions {
  double mu = 0;
  double mass_kg = 0;
  double gravity_m_s2 = 9.81;  ///< against the hand's up direction
  double force_factor = 1;     ///< of the limits of all actuators, times what the model has
  /// What the hand's sensors say of the angles of drives, by finger, less what they are, radians;
  /// none: nothing.
  std::vector<kinematics::Posture> joint_offsets = {};
  TipShape tip = TipShape::kBall;
};

/// Where a fingertip and the object touch.
struct TipTouch {
  Eigen::Vector3d point_O = Eigen::Vector3d::Zero();  ///< of the surface, nearest to the tip
  Eigen::Vector3d inward_O = Eigen::Vector3d::Zero();
  double gap = std::numeric_limits<double>::infinity();  ///< negative: the tip is in the surface
  Eigen::Vector3d force = Eigen::Vector3d::Zero();       ///< on the object, newtons
  Eigen::Vector3d sliding_O = Eigen::Vector3d::Zero();  ///< speed of the tip along the surface, m/s
};

/// A hand's own model in MuJoCo, its palm fixed, and a free object that only its fingertips hold.
///
/// The tips are balls, or what the model has there for collisions (TipShapesOf), that touch the
/// object's true surface (BallContact, FindContacts), with friction and no torsion. Links pass
/// through each other and the object: that they do not is for a judge to see.
/// Joints of no finger stay where they are at rest. All in the palm's frame, metres, newtons,
/// seconds; O is the object's frame (its file's axes and origin, in metres).
class HandWorld {
 public:
  /// All that what comes depends on, but for loads and what is pinned.
  struct State {
    EngineState engine;
    std::vector<double> controls;
  };

  /// @throws InputError  the hand's model does not allow it; as TipShapesOf.
  HandWorld(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
            const HandWorldOptions& options);
  ~HandWorld();
  HandWorld(const HandWorld&) = delete;
  HandWorld& operator=(const HandWorld&) = delete;

  [[nodiscard]] const kinematics::HandModel& hand() const;
  /// What the engine has, servos included that are derived.
  [[nodiscard]] const mjModel_& model() const;
  [[nodiscard]] double time() const;
  [[nodiscard]] double timestep() const;
  [[nodiscard]] const Eigen::Vector3d& centroid_O() const;

  /// Hand and object at once, at rest.
  void Place(const plan::HandState& state);
  [[nodiscard]] plan::HandState state() const;
  [[nodiscard]] Eigen::Isometry3d object_pose() const;
  [[nodiscard]] kinematics::Posture posture(FingerIndex finger) const;
  /// Angles of the finger's joints, coupled ones too, radians.
  [[nodiscard]] std::vector<double> joint_angles_of(FingerIndex finger) const;
  /// As the hand's sensors have it.
  [[nodiscard]] kinematics::Posture measured_posture(FingerIndex finger) const;
  [[nodiscard]] Eigen::Vector3d tip(FingerIndex finger) const;
  /// As in the last step; without a place where the surface is farther than 5 mm. The contacts of a
  /// tip that is no ball count as one: force is their sum, point and normal are their means,
  /// weighted with what each presses with.
  [[nodiscard]] TipTouch touch(FingerIndex finger) const;
  /// Where the tip's ball, whatever it is that touches, is near the surface, in the object's frame;
  /// nullopt where that is farther than 5 mm.
  [[nodiscard]] std::optional<collision::NearPoint> NearBall(FingerIndex finger) const;
  [[nodiscard]] const DriveServo& servo(FingerIndex finger, int drive) const;
  /// Of the model's actuators, in its order; one without a name is called after its number.
  [[nodiscard]] std::vector<std::string> control_names() const;
  /// Their controls, as in the last step.
  [[nodiscard]] std::vector<double> controls() const;
  /// @param controls  of all actuators, in the model's order, until they are set again.
  void SetControls(const std::vector<double>& controls);
  /// Of all joints of the hand's model, those of no finger too, in its order.
  [[nodiscard]] std::vector<std::string> joint_names() const;
  /// Their angles, radians.
  [[nodiscard]] std::vector<double> joint_angles() const;
  /// What the actuator of a drive does now, over its limit; 0 where it has none.
  [[nodiscard]] double load_share(FingerIndex finger, int drive) const;
  /// Torque of the actuator about the drive now, N m.
  [[nodiscard]] double torque(FingerIndex finger, int drive) const;
  /// Whether the control of the drive is at an end of its range (`ctrlrange`).
  [[nodiscard]] bool is_control_at_limit(FingerIndex finger, int drive) const;
  /// The limits of all drives, by finger.
  [[nodiscard]] std::vector<DriveLimits> limits() const;
  /// The coupling of joints that is farthest off, as the model has them as constraints.
  [[nodiscard]] JointCouplings::Residual largest_coupling_residual() const;
  /// "joint ffj1, which is coupled to ffj2,".
  [[nodiscard]] std::string CouplingText(int equality) const;
  /// The finger of a coupling's first joint and the joint's place in it; not valid and −1 if it is
  /// a joint of no finger.
  [[nodiscard]] std::pair<FingerIndex, int> JointOfCoupling(int equality) const;
  /// All links of the hand, collision geometry of its fingertips included.
  [[nodiscard]] const HandLinks& links() const;
  [[nodiscard]] TipShape tip_shape() const;
  /// The torques of the drives with which a force at the tip's contact and the weight of the links
  /// balance.
  /// @param force  of the tip on the object.
  [[nodiscard]] Eigen::VectorXd BalancingTorques(FingerIndex finger, const Eigen::Vector3d& at,
                                                 const Eigen::Vector3d& force) const;
  /// The servos steer for a posture, as the sensors have it, with torques besides.
  void Command(FingerIndex finger, const kinematics::Posture& target,
               const Eigen::VectorXd& torques);
  /// A force and a torque about the centroid on the object, besides its weight.
  void SetLoad(const Eigen::Vector3d& force, const Eigen::Vector3d& torque);

  /// While on, the object stays where it is.
  void PinObject(bool on);

  /// One time step.
  /// @throws UnstableError
  void Step();

  [[nodiscard]] State Save() const;
  /// Without loads. What comes then is the same to the bit, whatever was before.
  void Restore(const State& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::sim
