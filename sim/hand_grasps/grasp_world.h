#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "planner/kinematics/mujoco_model.h"
#include "planner/object/polyhedron.h"
#include "sim/hand_grasps/hand_grasp.h"
#include "sim/hand_grasps/whole_hand.h"
#include "sim/scene/engine.h"

namespace regrasp::sim {

/// Name of the object's body in the world.
inline constexpr const char* kGraspObject = "regrasp_object";

/// Physics of a world in which a protocol simulates a grasp.
struct GraspPhysics {
  double mu = 0.6;           ///< friction coefficient between hand and object
  double torsion_mu = 0.02;  ///< torsional friction length, metres (condim 4 of MuJoCo)
  double mass_kg = 0.1;      ///< mass of the object
};

/// The whole hand and the free object in MuJoCo.
///
/// All collision geometry of the hand touches the object and, as in its model, itself. The palm
/// follows the mount by a weld, as in DexGraspBench. Gravity is off; loads on the object
/// replace it. The object is its convex pieces if they are given. Otherwise a convex object is one
/// mesh, and any other object is its surface shell (surface_shell.h), which takes more time.
///
/// Actuators of the model are position servos, or become such servos. Contact stiffness, time step,
/// integrator and friction cones are those of DexGraspBench (docs/evaluate_grasps.md).
class GraspWorld {
 public:
  /// A joint of the hand, except joints above the palm.
  struct JointRange {
    std::string name;
    bool slides = false;  ///< whether it is prismatic
    bool limited = false;
    double lower = 0, upper = 0;  ///< radians or metres
  };

  /// Points whose convex hulls together are the object, in its frame and unit.
  using Pieces = std::vector<std::vector<Eigen::Vector3d>>;

  /// @param scale   metres per unit of the object's file.
  /// @param pieces  convex pieces of the object; empty: none.
  /// @throws InputError  if MuJoCo rejects the hand together with the object.
  GraspWorld(const WholeHand& hand, const object::Polyhedron& solid, double scale,
             const Pieces& pieces = {});

  void SetPhysics(const GraspPhysics& physics);

  [[nodiscard]] const std::vector<JointRange>& joints() const { return joints_; }
  [[nodiscard]] const mjModel& model() const { return *model_; }
  [[nodiscard]] const mjData& data() const { return *data_; }

  /// Check that a configuration has the joints of the hand.
  /// @param where  place in messages.
  /// @throws InputError  if a name is not a joint of the hand, or a joint that follows no other is
  ///     missing.
  void CheckJoints(const HandConfiguration& configuration, const std::string& where) const;
  /// Return a configuration after a closing motion (HandGrasp::closing).
  /// @param where  place in messages.
  /// @throws InputError  if a name is not a joint of the hand, or a joint has no range.
  [[nodiscard]] HandConfiguration Closed(const HandConfiguration& configuration,
                                         const std::map<std::string, double>& closing,
                                         const std::string& where) const;

  /// Place the hand and the object without velocity, with the actuators at the configuration.
  void Place(const HandConfiguration& configuration);
  /// Command a configuration that is a share between two configurations: the palm and the
  /// actuators.
  void Command(const HandConfiguration& from, const HandConfiguration& to, double share);
  /// Set the force on the object at its centroid, in newtons in the frame of the placed object.
  void SetForce(const Eigen::Vector3d& force);
  /// Simulate a time step. @throws UnstableError  if the simulation becomes unstable.
  void Step();

  [[nodiscard]] EngineState Save() const;
  void Restore(const EngineState& state);

  /// Return the pose of the object's file frame in the frame in which it was placed.
  [[nodiscard]] Eigen::Isometry3d object_pose() const;
  /// Return the pose of the palm in the same frame.
  [[nodiscard]] Eigen::Isometry3d palm_pose() const;
  /// Return the positions of all joints of the hand by name, radians or metres.
  [[nodiscard]] std::map<std::string, double> joint_positions() const;
  /// Return the object's centroid in the frame of its file, metres.
  [[nodiscard]] const Eigen::Vector3d& centroid() const { return centroid_; }
  /// Return whether the hand touches the object in the last step.
  [[nodiscard]] bool IsTouched() const;
  /// Return the smallest signed distance between colliding links of the hand, metres; 0 without
  /// contacts between links.
  [[nodiscard]] double SelfDistance() const;
  /// Return the bodies of the hand that have collision geometry.
  [[nodiscard]] const std::vector<int>& links() const { return links_; }
  /// Return Jᵀd for a point of a link: per joint, the velocity of the point along the direction d
  /// at unit joint velocity.
  /// @param point, direction  in the frame of the placed object, metres.
  /// @returns by joint name: metres per radian, or a ratio for prismatic joints.
  [[nodiscard]] std::map<std::string, double> JointMotion(int link, const Eigen::Vector3d& point,
                                                          const Eigen::Vector3d& direction) const;
  /// Return a configuration with its joints clamped to their ranges.
  [[nodiscard]] HandConfiguration WithinRange(HandConfiguration configuration) const;

  static constexpr double kTimestep = 0.004;  ///< seconds

 private:
  /// Return a joint by name.
  /// @throws InputError  if it is not a joint of the hand.
  [[nodiscard]] const JointRange& FindJoint(const std::string& name,
                                            const std::string& where) const;
  void FindParts(const WholeHand& hand);
  void FindFollowers();
  void SetContacts();
  void MakeServos();
  void SetOptions();
  void SetQpos(const HandConfiguration& configuration, mjData& data) const;
  [[nodiscard]] std::vector<double> ControlsAt(const HandConfiguration& configuration) const;

  /// A joint that an equality constraint moves with another joint.
  struct Follower {
    int joint = 0, leader = 0;
    const mjtNum* coefficients = nullptr;
  };

  EngineHooks hooks_;
  kinematics::ModelPtr model_;
  kinematics::DataPtr data_;
  kinematics::DataPtr scratch_;
  Eigen::Vector3d centroid_;
  int object_body_ = 0, object_qpos_ = 0, palm_ = 0, hand_qpos_ = 0;
  double mass_ = 1;
  std::vector<JointRange> joints_;
  std::map<std::string, int, std::less<>> joint_ids_;
  std::vector<Follower> followers_;
  std::vector<int> links_;
  std::vector<bool> is_link_;
};

}  // namespace regrasp::sim
