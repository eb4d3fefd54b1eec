#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/planning/in_hand_task.h"
#include "sim/replay/replay.h"
#include "sim/replay/trials.h"
#include "sim/scene/settings.h"
#include "sim/world/replay_observer.h"

namespace regrasp::sim {

/// Options of a replay by the actuators of a hand. The friction is the plan's, and so is the mass
/// by default (UseMassOf).
struct HandReplayOptions : ReplayConditions {
  HandTolerance tolerance;
  HandSensing sensing;
  HandPhysics physics;
  TipShape tip = TipShape::kBall;  ///< geometry of the fingertips that touches the object
  double force_factor = 1;         ///< factor on the force limits of all actuators
  bool to_end = false;             ///< whether the replay continues after a failed step, to its end
  EngineChoice engine = EngineChoice::kMujoco;
  double freeze_s = 1;  ///< time for which each static grasp must hold under constant controls
  /// Initial offset of the object's centroid from the plan, in the object's frame.
  Eigen::Vector3d start_shift_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d start_turn_rad =
      Eigen::Vector3d::Zero();  ///< initial rotation vector off the plan
};

/// Replay a plan for a hand on the hand's own model with HandControl, in MuJoCo (HandWorld) or ODE
/// (OdeHand). With EngineChoice::kBoth the result is MuJoCo's. Each step also has that of ODE.
/// The hand grasps the object and executes each step. In each static grasp all controls are kept
/// constant for a while, and then the object is disturbed.
///
/// A pass is a statement about this friction and mass. The actuators of the hand's model move the
/// object along the plan to within the tolerance, and only fingertips hold it. The replay uses no
/// result of the analytic check.
///
/// With TipShape::kGeometry the planned spheres still decide the placement of
/// fingers, the place of each fingertip on the object, and contact of a finger.
///
/// Deterministic: the same plan gives the same bits.
/// @param plan   plan for a hand, located on the object.
/// @param observer  with ODE alone only its `on_progress` is called.
/// @param steps     number of steps to replay, initial grasp included; negative: all.
/// @throws InputError  if the hand's model cannot be simulated.
/// @throws std::invalid_argument  if gravity acts on the plan in another direction than on the hand
///     (kinematics::HandOfPlan).
[[nodiscard]] ReplayResult ReplayHand(const kinematics::HandFile& file,
                                      const object::Polyhedron& solid, const plan::Plan& plan,
                                      const HandReplayOptions& options,
                                      const ReplayObserver& observer = {}, int steps = -1);

/// Return the grasp force that the static grasp after a number of steps requires, and the one that
/// the actuators exert (ComputeGraspForceNeed).
/// @param plan   as in ReplayHand.
/// @param steps  number of steps; limited to those of the plan.
/// @throws InputError  if the hand's model cannot be simulated.
[[nodiscard]] std::optional<planning::GraspForceNeed> MeasureGraspForce(
    const kinematics::HandFile& file, const object::Polyhedron& solid, const plan::Plan& plan,
    const HandReplayOptions& options, int steps);

/// Replays plans one after another, each from the first step that differs from earlier plans.
class HandReplays {
 public:
  /// @param solid  object; must outlive this object.
  HandReplays(kinematics::HandFile file, const object::Polyhedron& solid,
              const HandReplayOptions& options);
  ~HandReplays();
  HandReplays(const HandReplays&) = delete;
  HandReplays& operator=(const HandReplays&) = delete;

  /// Return the result of ReplayHand, to the bit, without the steps after the deadline.
  /// @throws InputError, std::invalid_argument  as ReplayHand.
  [[nodiscard]] ReplayResult Replay(const plan::Plan& plan, const Deadline& deadline);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Default of TrialOptions::position_noise in a replay by a hand: 0.3 mm on an object of 100 mm,
/// the noise of the default camera (HandSensing).
inline constexpr double kHandPositionNoise = 0.003;

/// Replay a plan by its hand `trials.count` times in perturbed worlds.
/// Friction and mass differ as in RunTrials. The initial object pose differs along and about each
/// axis by a normal deviate (position_noise · D, and that over R in radians). Each measured joint
/// angle has a constant error (joint_noise). The sensors have the noise of the nominal replay, with
/// a different seed in each trial.
///
/// Laws: trial k depends on the seeds and k alone. Without errors and without noise of the sensors
/// every trial is the nominal replay.
/// @param options   options of the nominal replay, which passes.
/// @param progress  callback after every trial; may be empty.
/// @throws std::invalid_argument  as RunTrials. @throws InputError  as ReplayHand.
[[nodiscard]] TrialSummary RunHandTrials(const kinematics::HandFile& file,
                                         const object::Polyhedron& solid, const plan::Plan& plan,
                                         const HandReplayOptions& options,
                                         const TrialOptions& trials,
                                         const std::function<void(int done)>& progress = {});

}  // namespace regrasp::sim
