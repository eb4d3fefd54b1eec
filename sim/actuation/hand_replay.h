#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/replay/replay.h"
#include "sim/replay/trials.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

class HandWorld;

struct HandReplayOptions {
  HandTolerance tolerance;
  bool feedback = true;              ///< joint targets are corrected by the object's offset
  TipShape tip = TipShape::kBall;    ///< what of a fingertip touches the object
  std::optional<double> half_angle;  ///< friction, radians; the plan's where left out
  double mass_kg = 0;
  std::optional<double> squeeze_N;  ///< otherwise derived (DeriveSqueeze)
  double shake = 0.01;              ///< over the squeeze; a torque also over R
  double friction_factor = 1;       ///< the world's friction over the one that the hand believes
  double mass_factor = 1;           ///< the object's true mass over the one that it believes
  double force_factor = 1;          ///< of the limits of all actuators, times what the model has
  /// Where the object is at first, from where the plan has it: of its centroid, in its own frame.
  Eigen::Vector3d start_shift_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d start_turn_rad = Eigen::Vector3d::Zero();  ///< a rotation vector
  std::vector<kinematics::Posture> joint_offsets = {};       ///< as HandWorldOptions
};

/// What a replay tells while it runs; all may be empty.
struct HandReplayObserver {
  std::function<void(const HandWorld&)> on_step;  ///< after every step of the world but in shakes
  /// At rest after an entry, before the shake.
  std::function<void(const HandWorld&, plan::EntryIndex)> on_rest;
  std::function<void(int done, int total)> on_progress;  ///< after every entry
};

/// Replays a plan for a hand on the hand's own model in MuJoCo (HandWorld), under HandControl:
/// takes hold, carries out each step, comes to rest and is shaken there.
///
/// What a pass means: with this friction and this mass the hand's actuators, as its model has them,
/// carried the object along the plan to within the tolerance, and nothing but its fingertips held
/// it. It believes nothing of the analytic check.
///
/// With the model's own tips (TipShape::kGeometry) all else goes by the planned balls: where
/// fingers are placed, where a tip is held on the object, and whether one is at its contact.
///
/// Deterministic: the same plan gives the same bits.
/// @param plan   located, with a hand.
/// @param steps  how many entries to replay, hold included; all where negative.
/// @throws InputError  the hand's model cannot be simulated.
[[nodiscard]] ReplayResult ReplayHand(const kinematics::HandFile& file,
                                      const object::Polyhedron& solid, const plan::Plan& plan,
                                      const HandReplayOptions& options,
                                      const HandReplayObserver& observer = {}, int steps = -1);

/// Replays plans one after another, and of each only what it has not in common with the beginning
/// of the one before it.
class HandReplays {
 public:
  /// @param solid  outlives this object.
  HandReplays(kinematics::HandFile file, const object::Polyhedron& solid,
              const HandReplayOptions& options);
  ~HandReplays();
  HandReplays(const HandReplays&) = delete;
  HandReplays& operator=(const HandReplays&) = delete;

  /// What ReplayHand gives, to the bit; after the deadline without the entries that were left.
  /// @throws InputError  as ReplayHand.
  [[nodiscard]] ReplayResult Replay(const plan::Plan& plan, const Deadline& deadline);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Replays a plan by its hand `trials.count` times in worlds that differ from what the hand
/// believes: friction and mass as in RunTrials; where the object is at first, along and about each
/// axis by a normal deviate (position_noise · D, and that over R in radians); and what each joint's
/// angle is off all along (joint_noise, 0 where left out), which it does not know of.
///
/// Laws: trial k depends on the seed and k alone; without any error every trial is the nominal
/// replay.
/// @param options   of the nominal replay, which passes.
/// @param progress  told after every trial; may be empty.
/// @throws std::invalid_argument  as RunTrials. @throws InputError  as ReplayHand.
[[nodiscard]] TrialSummary RunHandTrials(const kinematics::HandFile& file,
                                         const object::Polyhedron& solid, const plan::Plan& plan,
                                         const HandReplayOptions& options,
                                         const TrialOptions& trials,
                                         const std::function<void(int done)>& progress = {});

}  // namespace regrasp::sim
