#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "sim/actuation/hand_scene.h"
#include "sim/actuation/joint_drive.h"
#include "sim/actuation/link_couplings.h"
#include "sim/actuation/link_tree.h"
#include "sim/ode/ode_world.h"

namespace regrasp::sim {

/// Links of a hand and an object in ODE, their state and their time step, for OdeHand.
/// All quantities are in the world of the hand's model, metres, newtons, seconds.
struct OdeHandBodies {
  /// Velocity of a body: of its centre of mass, and its rotation.
  struct Motion {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
  };

  /// Contact of a fingertip in a step, in the world.
  struct Touch {
    FingerIndex finger;
    int number = 0;  ///< among those of the finger
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d inward = Eigen::Vector3d::Zero();  ///< unit normal into the object
    double depth = 0;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< on the object
  };

  HandScene& scene;
  LinkTree tree{scene};
  std::vector<JointDrive> drives = JointDrivesOf(scene, tree);
  std::vector<LinkCoupling> couplings = LinkCouplingsOf(scene, tree);
  /// Steps of ODE in a time step of the replay: links move on arcs, and a shorter step follows
  /// them more closely.
  static constexpr int kSubsteps = 2;
  double timestep = scene.options.physics.timestep_s / kSubsteps;  ///< time step of ODE

  OdeWorld world = MakeOdeWorld();
  OdeJointsPtr hinges{dJointGroupCreate(0)};
  OdeJointsPtr contact_joints{dJointGroupCreate(0)};
  dBodyID object = nullptr;
  std::vector<dBodyID> bodies;   ///< ODE body or joint, by link
  std::vector<dJointID> motors;  ///< ODE body or joint, by link
  std::vector<dJointID> rods;    ///< ODE joint, by coupling
  double mass = 0;               ///< mass of the object

  // State.
  double time = 0;
  Eigen::VectorXd angles, speeds;  ///< joint state, by link
  std::vector<Motion> motions;     ///< motions of the links' centres
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Motion object_motion;
  std::vector<Touch> touches;  ///< contacts in the last step

  // Inputs.
  std::vector<double> controls;  ///< controls, by actuator
  Eigen::Vector3d load = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
  bool pinned = false;

  // Results.
  std::vector<Eigen::Isometry3d> poses;  ///< poses of the links
  Eigen::VectorXd forces;                ///< forces of actuators, by link

  /// @param given  must outlive this object.
  /// @throws InputError  as LinkTree, JointDrivesOf and LinkCouplingsOf.
  explicit OdeHandBodies(HandScene& given);
  void MakeObject();
  void MakeLinks();
  void MakeHinge(int link);
  void MakeRods();

  [[nodiscard]] Eigen::Isometry3d ObjectPose() const {
    Eigen::Isometry3d pose = Eigen::Translation3d(centre) * turn;
    pose.translation() -= pose.linear() * scene.centroid;
    return pose;
  }
  [[nodiscard]] Eigen::Isometry3d TipLink(FingerIndex f) const {
    const LinkTree::Tip& tip = tree.tip(f);
    return poses[tip.link] * tip.in_link;
  }
  [[nodiscard]] JointDrive::Input InputOf(std::size_t link) const {
    const int i = static_cast<int>(link);
    const int a = drives[link].actuator;
    return {angles[i], speeds[i], a < 0 ? 0 : controls[a], timestep};
  }
  [[nodiscard]] Eigen::Vector3d CentreOf(std::size_t link) const {
    return poses[link] * tree.links()[link].centre;
  }
  [[nodiscard]] Eigen::Vector3d AxisOf(std::size_t link) const {
    return poses[link].linear() * tree.links()[link].axis;
  }
  [[nodiscard]] Eigen::Vector3d AnchorOf(std::size_t link) const {
    return poses[link] * tree.links()[link].anchor;
  }
  [[nodiscard]] Eigen::Vector3d SpeedOfLinkAt(int link, const Eigen::Vector3d& point) const {
    const Motion& motion = motions[link];
    return motion.velocity + motion.spin.cross(point - CentreOf(link));
  }
  [[nodiscard]] Eigen::Vector3d SpeedOfObjectAt(const Eigen::Vector3d& point) const {
    return object_motion.velocity + object_motion.spin.cross(point - centre);
  }

  /// Return the link of the joint that an independent joint's actuator moves.
  [[nodiscard]] int LeadingLink(FingerIndex finger, int drive) const;

  void Stop();
  void SetAngles(const Eigen::VectorXd& next);
  void FindTouches();
  void LoadBodies();
  void LoadMotors(const std::vector<int>& saturated);
  void LoadRods();
  void AddContacts(int tried, std::vector<Touch>& trial, std::vector<FrictionBox>& boxes,
                   std::vector<dJointFeedback>& feedback);
  [[nodiscard]] Eigen::VectorXd SolvedSpeeds() const;
  [[nodiscard]] bool Solve(int tried, std::vector<Touch>& trial);
  void Step();
  void TakeBodies();
};

}  // namespace regrasp::sim
