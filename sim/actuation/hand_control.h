#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <deque>
#include <optional>
#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/actuation/hand_engine.h"
#include "sim/actuation/hand_sensors.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// Settings of the controller of a hand, described in docs/validation.md.
struct HandControlSettings {
  double friction_angle = 0;  ///< friction angle for planned forces, radians
  double weight_N = 0;        ///< assumed weight of the object
  HandSensing sensing = {};
  bool gravity_support = false;  ///< whether grasps may hold the object by its weight
};

/// A holding finger that slides along the surface.
struct SlidingFinger {
  FingerIndex finger = {};
  Eigen::Vector3d direction_O = Eigen::Vector3d::Zero();  ///< direction of the fingertip's motion

  bool operator==(const SlidingFinger&) const = default;
};

/// The fingers whose forces hold the object.
struct Hold {
  std::vector<FingerIndex> fingers;
  double grasp_force_N = 0;                 ///< grasp force: sum of their normal forces
  std::vector<SlidingFinger> sliding = {};  ///< state of the sliding fingers

  bool operator==(const Hold&) const = default;
};

/// Blend of the fingers whose forces hold the object: from those of `from` to those of `to`.
struct HoldingFingers {
  Hold from;
  Hold to;
  double share = 1;     ///< share of the forces of `to`
  double strength = 1;  ///< factor on all forces
};

/// Return the joint configuration of a finger from the angles of its joints.
[[nodiscard]] kinematics::JointConfiguration ConfigurationOf(const kinematics::Finger& finger,
                                                             const std::vector<double>& angles);

/// Executes a plan with a hand, from joint and touch sensors and a slow, late measured object pose.
/// Every millisecond the servo of each joint receives a target and an additional torque:
///
/// - A holding fingertip has a place on the object, its anchor: the centre of its sphere in the
///   object's frame. The anchor moves only by rolling without slip, as follows from the measured
///   joints and the planned object pose. The target of the fingertip is its anchor at the
///   commanded object pose, so the stiffness of the servos holds the object on the planned path.
///   Joint targets follow by damped least squares, near the planned joints. The servo forces
///   present when a finger is attached decay within a tenth of a second.
/// - The commanded object pose is the planned pose, shifted by the integral of the measured
///   deviations, at most kMostOffset. A measurement is compared with the plan at its own time, so
///   a delay does not appear as a deviation.
/// - Torques balance the weight of the links and the planned forces at the contacts that follow
///   from the anchors. These forces support the object's weight with the largest margin inside the
///   friction cones. They are planned every hundredth of a second.
/// - The anchor of a sliding finger moves along the surface as planned. Its planned force is on the
///   edge of its cone, in the direction of motion. It is as small as possible while the other
///   fingers balance it.
/// - A free finger follows the planned joints. Its offset at release decays within a tenth of a
///   second.
class HandControl {
 public:
  HandControl(HandEngine& world, const object::Polyhedron& solid, double scale,
              const HandControlSettings& settings);

  /// Set the planned state of hand and object.
  /// @param planned  state with the joints of all fingers.
  void Steer(const plan::HandState& planned);
  void SetHolding(const HoldingFingers& holding) { holding_ = holding; }

  /// Keep the fingertip at its measured place on the object.
  void Attach(FingerIndex finger);
  /// Slide a fingertip along the surface.
  /// @param centre_O  target of the fingertip sphere's centre, in the object's frame. Only its
  ///                  place along the surface counts.
  void LeadAlongSurface(FingerIndex finger, const Eigen::Vector3d& centre_O);
  /// Return how well the other fingers balance the sliding fingers of a hold.
  /// @returns the smaller margin (grasp::SlidingNormal) of two cases: the present contacts, and the
  ///     sliding fingers at the end of their paths.
  [[nodiscard]] double SlidingMargin(const Hold& all, const plan::FingerGrasp& end) const;
  /// Make a finger follow the planned joints. Its present offset from them stays until LetOffsetGo.
  void Detach(FingerIndex finger);
  void LetOffsetGo(FingerIndex finger);
  /// Move a fingertip to a place in the object's frame instead of along the planned joints.
  void LeadTip(FingerIndex finger, const Eigen::Vector3d& centre_O);

  /// Return whether the touch sensor of a fingertip detects a contact.
  [[nodiscard]] bool Touches(FingerIndex finger) const { return sensors_.Touches(finger); }
  /// Return the centre of a fingertip sphere in the object's frame, from joints and plan.
  [[nodiscard]] Eigen::Vector3d TipInObject(FingerIndex finger) const;
  /// Return the estimated distance of a fingertip from the surface, or infinity beyond 5 mm.
  [[nodiscard]] double GapOf(FingerIndex finger) const;

  /// Set whether measured poses correct the object's offset.
  void SetFeedback(bool on) { corrects_ = on; }

  /// Take the state of another controller of the same world.
  void CopyState(const HandControl& other);

  /// Advance the world by one time step under control.
  /// @throws UnstableError  if the simulation becomes unstable, or the object is thrown about, so
  ///     that fingertips have no contact normals.
  void Step();

  /// Return the planned force of a finger on the object, in the palm's frame.
  [[nodiscard]] const Eigen::Vector3d& force(FingerIndex finger) const {
    return fingers_[finger].force;
  }

  /// Smallest normal force of a finger in contact, N
  inline static constexpr double kTouchForce = 0.1;
  /// period of force planning and measurements, seconds
  inline static constexpr double kPeriod = 0.01;
  /// largest correction of a point of the object, metres
  inline static constexpr double kMostOffset = 4e-3;

 private:
  enum class Mode { kFree, kLed, kAttached, kSliding };
  /// Place of a fingertip on the object.
  struct Anchor {
    Eigen::Vector3d centre_O = Eigen::Vector3d::Zero();  ///< centre of the sphere
    Eigen::Vector3d point_O = Eigen::Vector3d::Zero();   ///< contact
    Eigen::Vector3d inward_O = Eigen::Vector3d::Zero();
    Eigen::Matrix3d turn_O = Eigen::Matrix3d::Identity();  ///< orientation of the fingertip's link
    bool is_near = false;  ///< whether the surface is near the sphere
  };
  struct Finger {
    Mode mode = Mode::kFree;
    Anchor anchor;
    Eigen::Vector3d led_O = Eigen::Vector3d::Zero();  ///< target of a fingertip that is led
    Eigen::Vector3d bias = Eigen::Vector3d::Zero();   ///< offset of its target when it was attached
    kinematics::JointConfiguration target;
    kinematics::JointConfiguration offset;  ///< offset of a free finger from the planned joints
    kinematics::JointConfiguration rate;    ///< speed of the planned joints, per second
    bool keeps_offset = false;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< point of application of the force
  };

  /// Command of a finger's servos.
  struct Command {
    kinematics::JointConfiguration target;
    Eigen::VectorXd torques;
  };

  /// Send commands, which take effect after the delay of the sensing.
  void Send(std::vector<Command> commands);
  void Measure();
  void IntegrateDeviations();
  /// Integrate the deviation of the object pose at which the measured fingertips are at their
  /// anchors.
  void IntegrateTips();
  void Integrate(double share, const PoseDeviation& off);
  /// Move an anchor to a place near the surface, at a distance of the fingertip's radius.
  void PlaceAnchor(FingerIndex finger, const Eigen::Vector3d& centre_O);
  /// Return the orientation of the fingertip's link in the object's frame, from joints and plan.
  [[nodiscard]] Eigen::Matrix3d TipTurn(FingerIndex finger) const;
  /// Roll the fingertip along the surface as its joints have moved since the last time.
  void Roll(FingerIndex finger);
  void PlanForces();
  /// Return the part of a hold whose contacts are known.
  [[nodiscard]] Hold WithContacts(const Hold& hold) const;
  [[nodiscard]] grasp::Grasp ContactsOf(const std::vector<FingerIndex>& fingers) const;
  [[nodiscard]] grasp::GraspForces PlannedForces(const grasp::Grasp& contacts,
                                                 const Hold& hold) const;
  [[nodiscard]] std::vector<Eigen::Vector3d> ForcesOf(const Hold& all) const;
  [[nodiscard]] kinematics::JointConfiguration PlannedConfiguration(FingerIndex finger) const;
  [[nodiscard]] Eigen::VectorXd TorquesOf(FingerIndex finger) const;
  void FollowTip(FingerIndex finger);
  /// Return the object pose whose tracking brings the object to the planned pose.
  [[nodiscard]] Eigen::Isometry3d CommandedPose() const;

  HandEngine& world_;
  const object::Polyhedron& solid_;
  double scale_;
  double reach_;  ///< largest distance of the object's points from its centroid
  HandControlSettings settings_;
  HandSensors sensors_;
  plan::HandState planned_;
  HoldingFingers holding_;
  std::vector<Finger> fingers_;
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  std::deque<std::vector<Command>> sent_;  ///< commands that have no effect yet
  int step_ = 0;
  bool corrects_ = true;
};

}  // namespace regrasp::sim
