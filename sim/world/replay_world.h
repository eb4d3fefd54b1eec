#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/plan/snapshot.h"
#include "sim/scene/engine.h"
#include "sim/scene/scene.h"
#include "sim/world/motion_monitor.h"
#include "sim/world/replay_observer.h"

namespace regrasp::sim {

/// A finger in the world. B is the body's frame: metres about the centroid, fixed to the object.
struct WorldFinger {
  plan::FingerRole role = plan::FingerRole::kFree;
  bool holding = false;
  bool sliding = false;                                ///< moves along the surface on purpose
  grasp::Contact contact;                              ///< planned, in B
  std::vector<Eigen::Vector3d> path_B = {};            ///< planned, of a finger that moved
  Eigen::Vector3d touch_B = Eigen::Vector3d::Zero();   ///< where its slide counts from
  Eigen::Vector3d anchor_S = Eigen::Vector3d::Zero();  ///< tip at which the servo pushes nothing
  Eigen::Vector3d force_S = Eigen::Vector3d::Zero();   ///< feed-forward, on the object
};

/// The object, the hand and the engine between them.
///
/// A finger is a ball on servos without friction along each axis: the force on it is
/// k (anchor − tip) + force − damping · velocity, so a holding finger presses with `force` and
/// resists with stiffness k. Constant forces without stiffness lose every grasp.
class ReplayWorld {
 public:
  ReplayWorld(const object::Object& body, const plan::Plan& plan, Scene scene,
              const ReplayObserver& observer);

  [[nodiscard]] const ReplaySettings& settings() const { return scene_.settings; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] object::WrenchFrame frame_B() const;
  [[nodiscard]] double half_angle() const;
  [[nodiscard]] std::vector<WorldFinger>& fingers() { return fingers_; }
  [[nodiscard]] const std::vector<WorldFinger>& fingers() const { return fingers_; }
  /// The fingers that hold, in ascending order.
  [[nodiscard]] std::vector<FingerIndex> HoldingFingers() const;
  [[nodiscard]] Engine& engine() { return *engine_; }
  [[nodiscard]] const Engine& engine() const { return *engine_; }

  [[nodiscard]] Eigen::Isometry3d X_SB() const { return engine_->object_pose(); }
  /// Where the fingertip meets the surface, from the measured tip and the planned normal.
  [[nodiscard]] Eigen::Vector3d ContactPoint_B(FingerIndex finger) const;
  /// The torque of a finger about its normal over its torsion (ConeMargin); 0 of hard points.
  [[nodiscard]] double Twist(FingerIndex finger) const;
  /// The tip of a finger that would touch the object as it lies now at `contact_B`, `gap` away.
  [[nodiscard]] Eigen::Vector3d TipAt_S(const grasp::Contact& contact_B, double gap) const;
  /// The object's weight now, newtons along −z of S.
  [[nodiscard]] Eigen::Vector3d weight_S() const;

  void SetGravity(double gravity);
  void Step();
  /// How many steps a duration in natural times (ReplaySettings) takes, at least one.
  [[nodiscard]] int StepsIn(double duration) const;
  /// Runs for `duration` natural times; before each step calls `drive` with the share of the motion
  /// done after it.
  void Run(double duration, const std::function<void(double)>& drive);

  /// What happens from now on is measured against the object's pose as it is now.
  void StartMonitoring();
  /// Looks whether every holding finger still touches.
  void MonitorRest();
  MotionMonitor& monitor() { return monitor_; }
  [[nodiscard]] const MotionMonitor& monitor() const { return monitor_; }

  /// Samples go to the observer unless this is off (shakes are not part of the motion).
  void SetSampling(bool on) { sampling_ = on; }
  [[nodiscard]] plan::Snapshot TakeSnapshot() const;

 private:
  void MonitorMotion();
  void Sample();

  Eigen::Vector3d p_WS_;  ///< the centroid in W
  Scene scene_;
  const ReplayObserver& observer_;
  std::unique_ptr<Engine> engine_;
  std::vector<WorldFinger> fingers_;
  MotionMonitor monitor_;
  double gravity_ = 0;
  bool sampling_ = true;
  double next_sample_ = 0;
};

}  // namespace regrasp::sim
