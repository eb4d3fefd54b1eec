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

/// Return the square of the friction part of a force.
/// Evaluated for every finger in every time step, hence without a square root.
/// @param normal, twist  as in ConeMargin.
[[nodiscard]] inline double TangentialSquare(const Eigen::Vector3d& force,
                                             const Eigen::Vector3d& normal, double twist = 0) {
  return normal.cross(force).squaredNorm() + twist * twist;
}

/// Return the friction margin of a contact force, radians.
/// It is the friction angle minus the angle between the force on the object and the inward normal:
/// 0 for a force on its cone, negative outside.
/// @param normal  unit vector.
/// @param twist   for a soft finger, the torque about the normal over its torsion. It uses the same
///     friction as a tangential force of this size perpendicular to the actual one.
/// @pre the force is not zero.
[[nodiscard]] double ConeMargin(const Eigen::Vector3d& force, const Eigen::Vector3d& normal,
                                double friction_angle, double twist = 0);

/// Add a margin of a finger; the smallest one of each finger is kept.
void AddMargin(FingerIndex finger, double margin, FingerMargins& margins);

/// Return the smallest margin of all fingers.
[[nodiscard]] std::optional<double> SmallestMargin(const FingerMargins& margins);

/// Return the finger with the smallest margin; −1 if there is none.
[[nodiscard]] FingerIndex FingerOfSmallestMargin(const FingerMargins& margins);

/// Contact force over the grasp force below which fingers have no margin. The angle of a force that
/// appears or vanishes is meaningless, and the possible slip is negligible.
inline constexpr double kPressing = 1e-3;

/// Margin below which a force has reached its cone, radians (0.03°). The engine keeps forces inside
/// to 1e-6; forces planned with a margin of a hundredth of the cone are a tenth of a degree inside.
inline constexpr double kConeReached = 5e-4;

/// Measurements of one step in a replay, and their verdict.
///
/// The object moved if (|Δx| + R |Δrotation|) / D exceeds the tolerance, R = D/2, Δx of the
/// centroid. A finger slipped if it slid by more than the tolerance · D along the surface. A
/// contact is lost if a finger in a static grasp is more than kLostGap · D off the surface.
class MotionMonitor {
 public:
  explicit MotionMonitor(const ReplaySettings& settings) : settings_(settings) {}

  /// Reset all measurements, and measure from this pose.
  void Start(const Eigen::Isometry3d& X_SB);
  /// Set the name of the part of the step to which later measurements belong.
  /// It appears in messages, such as "during the align".
  void SetPhase(std::string phase) { phase_ = std::move(phase); }

  [[nodiscard]] const std::string& phase() const { return phase_; }

  void AddPose(const Eigen::Isometry3d& X_SB);
  /// Set whether the motion of the object is a compliance displacement.
  /// This is the displacement of the servos under a disturbance. It is measured separately and has
  /// no limit: the object has moved if it does not return.
  void SetGiving(bool on) { giving_ = on; }
  /// Record that the object did not become still; it then counts as moved, whatever its motion.
  void AddUnrest();
  void AddSlip(FingerIndex finger, double slip_m);
  /// @param gap_m  distance from the surface to the fingertip of a finger in a static grasp.
  void AddGap(FingerIndex finger, double gap_m);
  /// Record the contact force of a finger.
  /// @param force   force on the object; ignored if it is small (kPressing).
  /// @param normal  inward unit vector.
  /// @param twist  as in ConeMargin.
  void AddForce(FingerIndex finger, const Eigen::Vector3d& force, const Eigen::Vector3d& normal,
                double twist = 0);
  /// Reset the cone margins.
  void ForgetForces() { slope_squares_.clear(); }

  /// Return kNone, or the first of contact-lost, slipped and object-moved that applies.
  [[nodiscard]] plan::Reason reason() const;
  /// Describe the reason with its largest value so far and its first occurrence.
  /// Example: "finger 2 slipped by 300 µm during the align". Empty without a reason.
  [[nodiscard]] std::string detail() const;
  /// Return the finger that lost its contact or slipped first; not valid for other reasons.
  [[nodiscard]] FingerIndex finger() const;
  /// Object pose at the start of the measurement.
  [[nodiscard]] const Eigen::Isometry3d& start() const { return start_; }
  [[nodiscard]] double displacement_m() const { return displacement_; }
  [[nodiscard]] double rotation_rad() const { return rotation_; }
  /// Largest |Δx| + R |Δrotation|, to which the tolerance applies.
  [[nodiscard]] double moved_m() const { return moved_; }
  /// Return whether the object's displacement exceeds kLostMotion times the tolerance.
  /// Continuing the simulation would then take long and add no information.
  [[nodiscard]] bool lost() const;
  /// Largest |Δx| + R |Δrotation| during compliance displacements.
  [[nodiscard]] double give_m() const { return give_; }
  [[nodiscard]] double slip_m() const { return slip_; }
  [[nodiscard]] bool contact_lost() const { return lost_.has_value(); }
  /// Compute the margins of the fingers with contact forces.
  [[nodiscard]] FingerMargins margins() const;

 private:
  [[nodiscard]] std::string MotionText() const;

  ReplaySettings settings_;
  Eigen::Isometry3d start_ = Eigen::Isometry3d::Identity();
  std::string phase_;
  double displacement_ = 0, rotation_ = 0, moved_ = 0, moved_now_ = 0, give_ = 0, slip_ = 0;
  double slip_now_ = 0, gap_now_ = 0;  ///< largest values of slipped_finger_ and lost_finger_
  bool giving_ = false;
  bool unrest_ = false;  ///< whether the object moved because it did not become still
  /// Largest squared ratio of tangential to normal force [finger].
  std::vector<double> slope_squares_;
  std::optional<std::string> lost_, slipped_, object_moved_;  ///< phase of the first occurrence
  FingerIndex lost_finger_, slipped_finger_;
};

/// Return |Δx| + R |Δrotation|, metres, between two poses of an object of diameter 2R.
[[nodiscard]] double MeasureMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                   double radius);

/// Distance off the surface, over D, at which a finger in a static grasp has lost its contact;
/// contacts in use are 1e-7 D deep.
inline constexpr double kLostGap = 1e-5;

inline constexpr double kLostMotion = 10;  ///< over the tolerance

}  // namespace regrasp::sim
