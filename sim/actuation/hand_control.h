#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// Settings of the controller of a hand, described in docs/validation.md.
struct HandControlSettings {
  double half_angle = 0;  ///< friction angle for planned forces, radians
  double squeeze_N = 0;   ///< sum of the normal forces of a grasp
  double weight_N = 0;    ///< assumed weight of the object
  bool feedback = true;   ///< whether the measured offset of the object corrects joint targets
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
  std::vector<SlidingFinger> sliding = {};  ///< those of the fingers that slide

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
[[nodiscard]] kinematics::Posture PostureOf(const kinematics::Finger& finger,
                                            const std::vector<double>& angles);

/// Executes a plan with a hand.
/// Every millisecond the servo of each joint receives a target and an additional torque:
///
/// - The target of a holding fingertip assumes that the object is at its planned pose. The
///   fingertip keeps its measured place on the object, so that it may roll. Joint targets follow by
///   damped least squares, near the planned joints. The servo forces present when a finger is
///   attached decay within a tenth of a second. Otherwise fingers would press against each other
///   with more than the planned forces.
/// - The planned pose is shifted by the integral of the object's measured offset, at most
///   kMostOffset.
/// - Torques balance the weight of the links and the planned forces at the measured contacts. These
///   forces support the object's weight with the largest margin inside the friction cones. They are
///   planned every hundredth of a second.
/// - A sliding finger is guided along the surface. Along the normal it behaves as a holding finger.
///   Its planned force is on the edge of its cone, in the direction of motion. It is as small as
///   possible while the other fingers balance it.
/// - A free finger follows the planned joints. Its offset at release decays within a tenth of a
///   second.
class HandControl {
 public:
  HandControl(HandWorld& world, const object::Polyhedron& solid, double scale,
              const HandControlSettings& settings);

  /// Set the planned state of hand and object.
  /// @param planned  state with the joints of all fingers.
  void Steer(const plan::HandState& planned);
  void SetHolding(const HoldingFingers& holding) { holding_ = holding; }

  /// Keep the fingertip at its present place on the object.
  void Attach(FingerIndex finger);
  /// Slide a fingertip along the surface.
  /// Its distance from the target along the normal does not count.
  /// @param centre_O  target of the fingertip sphere's centre, in the object's frame.
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

  /// Set whether the object's offset is corrected, if the settings have feedback.
  void SetFeedback(bool on) { corrects_ = on; }

  /// Take the state of another controller of the same world.
  void CopyState(const HandControl& other);

  /// Advance the world by one time step under control.
  void Step();

  /// Return the planned force of a finger on the object, in the palm's frame.
  [[nodiscard]] const Eigen::Vector3d& force(FingerIndex finger) const {
    return fingers_[finger].force;
  }

  /// smallest normal force of a finger in contact, N
  inline static constexpr double kTouchForce = 0.1;
  /// period of force planning and measurements, seconds
  inline static constexpr double kPeriod = 0.01;
  /// largest correction of a point of the object, metres
  inline static constexpr double kMostOffset = 4e-3;

 private:
  enum class Mode { kFree, kLed, kAttached, kSliding };
  struct Finger {
    Mode mode = Mode::kFree;
    Eigen::Vector3d centre_O = Eigen::Vector3d::Zero();
    Eigen::Vector3d led_O = Eigen::Vector3d::Zero();  ///< target of a sliding finger
    Eigen::Vector3d bias = Eigen::Vector3d::Zero();   ///< offset of its target when it was attached
    kinematics::Posture target;
    kinematics::Posture offset;  ///< offset of a free finger from the planned joints
    kinematics::Posture rate;    ///< speed of the planned joints, per second
    bool keeps_offset = false;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< point of application of the force
    TipTouch touched;  ///< contact, or the last one while the object was near
  };

  void Measure();
  void PlanForces();
  /// Return the contact of a finger, or the last one while the object was near; nullopt if none.
  [[nodiscard]] std::optional<TipTouch> KnownTouch(FingerIndex finger) const;
  /// Return the part of a hold whose contacts are known.
  [[nodiscard]] Hold WithContacts(const Hold& hold) const;
  [[nodiscard]] grasp::Grasp ContactsOf(const std::vector<FingerIndex>& fingers) const;
  [[nodiscard]] grasp::GraspForces PlannedForces(const grasp::Grasp& contacts,
                                                 const Hold& hold) const;
  [[nodiscard]] std::vector<Eigen::Vector3d> ForcesOf(const Hold& all) const;
  [[nodiscard]] kinematics::Posture PlannedPosture(FingerIndex finger) const;
  [[nodiscard]] Eigen::VectorXd TorquesOf(FingerIndex finger) const;
  void FollowTip(FingerIndex finger);
  [[nodiscard]] Eigen::Isometry3d CorrectedPose() const;

  HandWorld& world_;
  const object::Polyhedron& solid_;
  double scale_;
  double reach_;  ///< largest distance of the object's points from its centroid
  HandControlSettings settings_;
  plan::HandState planned_;
  HoldingFingers holding_;
  std::vector<Finger> fingers_;
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  int step_ = 0;
  bool corrects_ = true;
};

}  // namespace regrasp::sim
