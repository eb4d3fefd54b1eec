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

/// What the controller of a hand goes by; docs/validation.md describes it.
struct HandControlSettings {
  double half_angle = 0;  ///< friction that forces are planned with, radians
  double squeeze_N = 0;   ///< sum of the normal forces of a grasp
  double weight_N = 0;    ///< of the object, as the hand believes
  bool feedback = true;   ///< joint targets are corrected by the measured offset of the object
};

/// A holding finger that slides along the surface.
struct SlidingFinger {
  FingerIndex finger = {};
  Eigen::Vector3d direction_O = Eigen::Vector3d::Zero();  ///< where its tip goes

  bool operator==(const SlidingFinger&) const = default;
};

/// The fingers whose forces hold the object.
struct Hold {
  std::vector<FingerIndex> fingers;
  std::vector<SlidingFinger> sliding = {};  ///< of these

  bool operator==(const Hold&) const = default;
};

/// Whose forces hold the object: those of `from`, going over to those of `to`.
struct HoldingFingers {
  Hold from;
  Hold to;
  double share = 1;     ///< of `to`
  double strength = 1;  ///< of all of it
};

/// The posture of joints that are told one by one.
[[nodiscard]] kinematics::Posture PostureOf(const kinematics::Finger& finger,
                                            const std::vector<double>& angles);

/// Carries out a plan with a hand. Every millisecond each joint's servo steers for a target with a
/// torque besides:
///
/// - The tip of a finger that holds is to be where it would be if the object were at its planned
///   pose: it keeps its place on the object as measured, so that it may roll. The target's joints
///   follow by damped least squares, near the planned ones. What servos pressed with when a finger
///   was attached goes in a tenth of a second, or fingers would push against each other with more
///   than is planned.
/// - The planned pose is moved by the integral of the object's measured offset, at most
/// kMostOffset.
/// - Torques balance the weight of the links and the planned forces at the contacts as measured:
///   those that hold the object's weight with the largest margin inside the cones, anew every
///   hundredth of a second.
/// - A finger that slides is led along the surface, and along the normal does as one that holds.
/// Its
///   planned force is on the edge of its cone, the way it goes, and as small as lets the others
///   balance it.
/// - A free finger follows the planned joints; what it was off when it came free goes in a tenth of
///   a second.
class HandControl {
 public:
  HandControl(HandWorld& world, const object::Polyhedron& solid, double scale,
              const HandControlSettings& settings);

  /// Where hand and object should be now. @param planned  with the joints of all fingers.
  void Steer(const plan::HandState& planned);
  void SetHolding(const HoldingFingers& holding) { holding_ = holding; }

  /// The finger's tip stays where it is on the object from now on.
  void Attach(FingerIndex finger);
  /// It slides along the surface, towards where its tip is to be, a place in the object's frame;
  /// what of that is along the normal does not count.
  void LeadAlongSurface(FingerIndex finger, const Eigen::Vector3d& centre_O);
  /// How well the others balance the fingers of a hold that slide, with the contacts as they are
  /// and with those that slide at the end of their ways: the smaller margin (grasp::SlidingNormal).
  [[nodiscard]] double SlidingMargin(const Hold& all, const plan::FingerGrasp& end) const;
  /// It follows the planned joints from now on; what it is off them now it is all along, until
  /// LetOffsetGo.
  void Detach(FingerIndex finger);
  void LetOffsetGo(FingerIndex finger);
  /// Its tip goes there instead, a place in the object's frame.
  void LeadTip(FingerIndex finger, const Eigen::Vector3d& centre_O);

  /// Whether the object's offset is corrected, where it is at all.
  void SetFeedback(bool on) { corrects_ = on; }

  /// What another controller of the same world is about to do.
  void CopyState(const HandControl& other);

  /// One step of the world under control.
  void Step();

  /// The force on the object that a finger is asked for, in the palm's frame.
  [[nodiscard]] const Eigen::Vector3d& force(FingerIndex finger) const {
    return fingers_[finger].force;
  }

  inline static constexpr double kTouchForce = 0.1;   ///< N, of a finger that touches, at least
  inline static constexpr double kPeriod = 0.01;      ///< of forces and measurements, seconds
  inline static constexpr double kMostOffset = 4e-3;  ///< metres, of a point of the object

 private:
  enum class Mode { kFree, kLed, kAttached, kSliding };
  struct Finger {
    Mode mode = Mode::kFree;
    Eigen::Vector3d centre_O = Eigen::Vector3d::Zero();
    Eigen::Vector3d led_O = Eigen::Vector3d::Zero();  ///< of one that slides
    Eigen::Vector3d bias = Eigen::Vector3d::Zero();   ///< of its target since it was attached
    kinematics::Posture target;
    kinematics::Posture offset;  ///< of a free finger from the planned joints
    kinematics::Posture rate;    ///< of the planned joints, per second
    bool keeps_offset = false;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< where the force acts
    TipTouch touched;  ///< where it is, or was while the object was near
  };

  void Measure();
  void PlanForces();
  /// Where a finger touches, or did while the object was near; not known if it never did.
  [[nodiscard]] std::optional<TipTouch> KnownTouch(FingerIndex finger) const;
  /// The fingers of a hold whose contacts are known.
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
  double reach_;  ///< of the object's points from its centroid
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
