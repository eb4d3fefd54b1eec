#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/plan/reason.h"
#include "sim/scene/measured.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// The square of what of a force is friction; it is asked of every finger in every time step.
/// @param normal, twist  as in ConeMargin.
[[nodiscard]] inline double TangentialSquare(const Eigen::Vector3d& force,
                                             const Eigen::Vector3d& normal, double twist = 0) {
  return normal.cross(force).squaredNorm() + twist * twist;
}

/// What is left of the friction of a contact: the friction half-angle minus the angle between the
/// force on the object and the inward normal, radians. 0 where the force lies on its cone, negative
/// outside.
/// @param normal  unit.
/// @param twist   of a soft finger its torque about the normal over its torsion: it takes of the
///     same friction as a tangential force of this size at right angles to the one that there is.
/// @pre the force is not zero.
[[nodiscard]] double ConeMargin(const Eigen::Vector3d& force, const Eigen::Vector3d& normal,
                                double half_angle, double twist = 0);

/// Of several margins of a finger the smallest stays.
void AddMargin(FingerIndex finger, double margin, FingerMargins& margins);

/// The smallest of all.
[[nodiscard]] std::optional<double> SmallestMargin(const FingerMargins& margins);

/// The finger with the smallest, −1 for none.
[[nodiscard]] FingerIndex FingerOfSmallestMargin(const FingerMargins& margins);

/// Fingers that press with less than this, over the squeeze, have no margin: the angle of a force
/// that comes or goes says nothing, and what it can slip is nothing.
inline constexpr double kPressing = 1e-3;

/// A margin below this is a force that reached its cone, radians (0.03°): the engine keeps forces
/// inside to 1e-6, forces planned with a margin of a hundredth of the cone stay a tenth of a degree
/// off.
inline constexpr double kConeReached = 5e-4;

/// What a replay measures of one step, and its verdict.
///
/// The object moved where (|Δx| + R |Δrotation|) / D exceeds the tolerance, R = D/2, Δx of the
/// centroid; a finger slipped where it slid by more than the tolerance · D along the surface; a
/// contact is lost where a finger at rest is off the surface by more than kLostGap · D.
class MotionMonitor {
 public:
  explicit MotionMonitor(const ReplaySettings& settings) : settings_(settings) {}

  /// Forgets everything and measures from this pose.
  void Start(const Eigen::Isometry3d& X_SB);
  /// What is measured next belongs to this part of the step, for people: "during the align",
  /// "under a push of 5.3 N along +x".
  void SetPhase(std::string phase) { phase_ = std::move(phase); }

  [[nodiscard]] const std::string& phase() const { return phase_; }

  void AddPose(const Eigen::Isometry3d& X_SB);
  /// While on, how far the object moves is the give of the servos under a push, which counts apart
  /// and has no limit: the object has moved where it does not come back.
  void SetGiving(bool on) { giving_ = on; }
  /// The object did not come to rest: it has moved, however far it came.
  void AddUnrest();
  void AddSlip(FingerIndex finger, double slip_m);
  /// @param gap_m  from the surface to the fingertip of a finger at rest.
  void AddGap(FingerIndex finger, double gap_m);
  /// @param force   of a finger on the object; left out where it hardly presses (kPressing).
  /// @param normal  inward, unit. @param twist  as in ConeMargin.
  void AddForce(FingerIndex finger, const Eigen::Vector3d& force, const Eigen::Vector3d& normal,
                double twist = 0);
  /// Cone margins are smallest from here on.
  void ForgetForces() { slope_squares_.clear(); }

  /// kNone, or the first of contact-lost, slipped and object-moved that applies.
  [[nodiscard]] plan::Reason reason() const;
  /// What the reason is, with its largest number so far and when it was seen first: "finger 2
  /// slipped by 300 µm during the align"; empty where there is none.
  [[nodiscard]] std::string detail() const;
  /// The finger that lost its contact or slipped first; not valid where the reason is another.
  [[nodiscard]] FingerIndex finger() const;
  /// Where the object was when measuring began.
  [[nodiscard]] const Eigen::Isometry3d& start() const { return start_; }
  [[nodiscard]] double displacement_m() const { return displacement_; }
  [[nodiscard]] double rotation_rad() const { return rotation_; }
  /// Largest |Δx| + R |Δrotation|, what the tolerance is about.
  [[nodiscard]] double moved_m() const { return moved_; }
  /// |Δx| + R |Δrotation| now.
  [[nodiscard]] double moved_now_m() const { return moved_now_; }
  /// Whether the object is so far from its place, kLostMotion times the tolerance, that to go on
  /// takes long and tells nothing.
  [[nodiscard]] bool lost() const;
  /// Largest |Δx| + R |Δrotation| while giving.
  [[nodiscard]] double give_m() const { return give_; }
  [[nodiscard]] double slip_m() const { return slip_; }
  [[nodiscard]] bool contact_lost() const { return lost_.has_value(); }
  /// Of the fingers that pressed; worked out by this call.
  [[nodiscard]] FingerMargins margins() const;

 private:
  [[nodiscard]] std::string MotionText() const;

  ReplaySettings settings_;
  Eigen::Isometry3d start_ = Eigen::Isometry3d::Identity();
  std::string phase_;
  double displacement_ = 0, rotation_ = 0, moved_ = 0, moved_now_ = 0, give_ = 0, slip_ = 0;
  double slip_now_ = 0, gap_now_ = 0;  ///< largest of slipped_finger_ and lost_finger_
  bool giving_ = false;
  bool unrest_ = false;  ///< the object moved in that it did not come to rest
  /// By finger: the largest tangential over its normal force, squared.
  std::vector<double> slope_squares_;
  std::optional<std::string> lost_, slipped_, object_moved_;  ///< the phase it was seen in first
  FingerIndex lost_finger_, slipped_finger_;
};

/// (|Δx| + R |Δrotation|), metres, between two poses of a body of diameter 2R.
[[nodiscard]] double MeasureMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                   double radius);

/// A finger at rest this far off the surface, over D, touches it no more; contacts that hold are
/// 1e-7 D deep.
inline constexpr double kLostGap = 1e-5;

inline constexpr double kLostMotion = 10;  ///< over the tolerance

}  // namespace regrasp::sim
