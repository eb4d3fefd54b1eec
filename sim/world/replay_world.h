#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/plan/projection.h"
#include "sim/scene/engine.h"
#include "sim/scene/scene.h"
#include "sim/world/motion_monitor.h"
#include "sim/world/replay_observer.h"

namespace regrasp::sim {

/// Finger in the simulated world. B is the body frame: metres about the centroid, fixed to the
/// object.
struct WorldFinger {
  plan::FingerRole role = plan::FingerRole::kFree;
  bool holding = false;
  bool sliding = false;                      ///< whether it moves along the surface intentionally
  grasp::Contact contact;                    ///< planned contact, in B
  std::vector<Eigen::Vector3d> path_B = {};  ///< planned path of a finger that moved
  Eigen::Vector3d touch_B = Eigen::Vector3d::Zero();   ///< reference point of its slip
  Eigen::Vector3d anchor_S = Eigen::Vector3d::Zero();  ///< fingertip position without servo force
  Eigen::Vector3d force_S = Eigen::Vector3d::Zero();   ///< feed-forward force on the object
};

/// Object, fingers and physics engine during a replay.
///
/// A finger is a sphere on servos without friction along each axis. The force on it is k (anchor −
/// fingertip) + force − damping · velocity. A holding finger thus applies `force` and resists with
/// stiffness k. Constant forces without stiffness lose every grasp.
class ReplayWorld {
 public:
  ReplayWorld(const object::Object& body, const plan::Plan& plan, Scene scene,
              const ReplayObserver& observer);

  [[nodiscard]] const ReplaySettings& settings() const { return scene_.settings; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] object::WrenchFrame frame_B() const;
  [[nodiscard]] double friction_angle() const;
  [[nodiscard]] std::vector<WorldFinger>& fingers() { return fingers_; }
  [[nodiscard]] const std::vector<WorldFinger>& fingers() const { return fingers_; }
  /// Return the fingers in contact, in ascending order.
  [[nodiscard]] std::vector<FingerIndex> HoldingFingers() const;
  [[nodiscard]] Engine& engine() { return *engine_; }
  [[nodiscard]] const Engine& engine() const { return *engine_; }

  [[nodiscard]] Eigen::Isometry3d X_SB() const { return engine_->object_pose(); }
  /// Return the contact point on the surface from the measured fingertip and the planned normal.
  [[nodiscard]] Eigen::Vector3d ContactPoint_B(FingerIndex finger) const;
  /// Return the torque of a finger about its normal over its torsion (ConeMargin).
  /// 0 for hard-finger contacts.
  [[nodiscard]] double Twist(FingerIndex finger) const;
  /// Return the fingertip position at a distance `gap` from `contact_B`.
  /// The object is in its current pose.
  [[nodiscard]] Eigen::Vector3d TipAt_S(const grasp::Contact& contact_B, double gap) const;
  /// Current weight of the object, newtons along −z of S.
  [[nodiscard]] Eigen::Vector3d weight_S() const;

  void SetGravity(double gravity);
  void Step();
  /// Return the number of steps of a duration, at least one.
  /// @param duration  duration in characteristic times (ReplaySettings).
  [[nodiscard]] int StepsIn(double duration) const;
  /// Simulate for `duration` characteristic times.
  /// @param drive  callback before each step with the share of the duration after the step.
  void Run(double duration, const std::function<void(double)>& drive);

  /// Start measurements relative to the current object pose.
  void StartMonitoring();
  /// Measure whether every holding finger still touches the object.
  void MonitorRest();
  MotionMonitor& monitor() { return monitor_; }
  [[nodiscard]] const MotionMonitor& monitor() const { return monitor_; }

  /// Set whether samples go to the observer.
  /// Off during disturbance tests, which are not part of the motion.
  void SetSampling(bool on) { sampling_ = on; }
  [[nodiscard]] plan::Snapshot TakeSnapshot() const;

 private:
  void MonitorMotion();
  void Sample();

  Eigen::Vector3d p_WS_;  ///< centroid in W
  Scene scene_;
  const ReplayObserver& observer_;
  std::unique_ptr<Engine> engine_;
  std::vector<WorldFinger> fingers_;
  MotionMonitor monitor_;
  double gravity_ = 0;
  bool sampling_ = true;
  double next_sample_ = 0;
};

/// Wait until the object and the fingers in contact are still.
/// They are still if none of them has moved by more than kStill · D in kStillTime. The wait ends
/// after kLongestWait, or when the object is lost (MotionMonitor::lost).
/// @return whether they became still.
/// @throws UnstableError  if the simulation becomes unstable.
bool WaitUntilStill(ReplayWorld& world);

/// Wait until everything is still when a static grasp is required.
/// The monitor records a failure to become still, and measures the contacts.
/// @throws UnstableError  if the simulation becomes unstable.
void ComeToRest(ReplayWorld& world);

/// Return the motion of an unsupported object under a disturbance of ρ F in a hold phase, over ρ D.
/// The force grows linearly during `ramp` and then acts for kLongestWait, both in characteristic
/// times. The acceleration is ρ F / M = ρ D over the characteristic time squared, so mass and grasp
/// force cancel.
[[nodiscard]] double FreeMotion(double ramp);

/// Duration of stillness in characteristic times √(M D / F)
/// (ReplaySettings::characteristic_time_s). A finger's servo settles in a tenth. The object
/// oscillates on the servos with a period of about one, well damped. If two fingers are close
/// together the period is ten, and it takes twenty to become still.
inline constexpr double kStillTime = 0.4;
/// Longest wait in characteristic times. An object slides if a disturbance exceeds the resisted
/// wrench by 1 / 800,000 of the grasp force; in this time it has moved by the default tolerance.
inline constexpr double kLongestWait = 40;
/// Limit of still motion over D. Contacts creep by less than 5e-8 in kStillTime. The engine softens
/// friction so that it yields by (1 − solimp) / impratio = 1e-6 of (1 / m + 1 / M) f. Its time
/// constant is half that of the contacts, which is two time steps. An unsupported object moves 8e-4
/// in this time under the default disturbance. An object that the grasp holds except for a
/// thousandth of the disturbance moves nearly 1e-6.
inline constexpr double kStill = 1e-6;
/// Upper bound on the extent of the object from an axis over its radius of gyration about that
/// axis: 1.4 for a rod's own axis, 2 for a cube's diagonal. Creeping contacts rotate a needle about
/// its long axis by a large angle, but none of its points moves far.
inline constexpr double kArmOfGyration = 3;

}  // namespace regrasp::sim
