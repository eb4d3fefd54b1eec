#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "planner/base/random.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"
#include "sim/replay/replay.h"
#include "sim/scene/settings.h"

namespace regrasp {
struct ShareInterval;  // planner/base/random.h
}

namespace regrasp::sim {

/// Error of the placement of fingers on the surface.
struct ContactNoise {
  double deviation = 0;  ///< standard deviation along the surface, each direction; object's unit
  double fingertip = 0;  ///< radius of the fingertip; object's unit
};

/// Return the plan as a hand with placement errors executes it.
/// Every contact moves along the surface by a normal deviate in each direction of its face,
/// straight and across borders (object/surface_walk.h). The size of faces therefore does not
/// matter. The contact has the normal of the face that it reaches.
///
/// The error of a finger is drawn once for each point of the plan. It persists through static
/// grasps, sliding steps and turns of the normal. In a sliding step the finger moves along the
/// surface from one place to the next, which can add waypoints. If no sphere of the fingertip's
/// radius fits, or no path along the surface is found, the error is drawn again, at most
/// kMostNoiseDraws times. Then the contact stays.
///
/// Deterministic. Without deviation the plan is unchanged.
/// @param plan  plan located on the object (PlanCheck::projected); its goal is not changed.
[[nodiscard]] plan::Plan AddContactNoise(const object::Object& object, const plan::Plan& plan,
                                         const ContactNoise& noise, RandomStream& random);

inline constexpr int kMostNoiseDraws = 100;

/// Replays of a plan in worlds that differ from what the hand assumes.
struct TrialOptions {
  int count = 0;
  std::uint64_t seed = 0;
  /// Standard deviation of every contact along the surface, over D: 1 mm on a body of 10 cm. The
  /// fingertips of a calibrated hand deviate by a few millimetres at most (3.7 mm for the DLR-Hand
  /// II: Tenhumberg, Sievers and Bäuml 2023).
  double position_noise = 0.01;
  double friction_error = 0.1;  ///< relative standard deviation of the friction coefficient
  double mass_error = 0.1;      ///< relative standard deviation of the mass
  /// Standard deviation of the error of a measured joint angle, radians; only for a replay by a
  /// hand (sim/actuation/hand_replay.h).
  std::optional<double> joint_noise = std::nullopt;
  /// Smallest share of trials that must pass for the plan to pass, in (0, 1].
  double min_pass_rate = 1;
};

/// Friction and mass of the world over those that the hand assumes.
struct TrialFactors {
  double friction = 1;
  double mass = 1;
};

/// Results of trials.
struct TrialSummary {
  TrialOptions options;
  int passed = 0;
  std::map<plan::Reason, int> reasons;    ///< number of failed trials by reason
  std::map<plan::EntryIndex, int> steps;  ///< number of failed trials by the first step that fails

  [[nodiscard]] double share() const;
  /// Return whether the share is at least `options.min_pass_rate`.
  [[nodiscard]] bool enough() const;
  /// Return the interval of the share, at kTrialConfidence.
  [[nodiscard]] ShareInterval interval() const;
};

/// Replay the plan `trials.count` times in perturbed worlds.
/// In each trial the placement of fingers has errors (AddContactNoise). Friction and mass of the
/// world differ from those that the hand assumes for its forces. The hand knows its contacts, as in
/// any replay. A trial passes if every step of the replay does.
///
/// Friction and mass are those assumed times 1 + error · (a normal deviate), at least kLeastFactor.
///
/// Laws: trial k depends on the seed and k alone. The same arguments give the same summary. Without
/// errors every trial is the nominal replay.
/// @param plan       plan located on the object; its nominal replay passes.
/// @param fingertip  radius of the fingertips in the nominal replay, metres.
/// @param progress   callback after every trial; may be empty.
/// @throws std::invalid_argument  if a count is below 1, or an error or noise is outside [0,
///     kMostError].
/// @throws InputError             as ReplayPlan.
[[nodiscard]] TrialSummary RunTrials(const object::Object& object, const plan::Plan& plan,
                                     const ReplayOptions& options, const TrialOptions& trials,
                                     double fingertip,
                                     const std::function<void(int done)>& progress = {});

/// Run trials, and count their results. Both replays use it.
/// @param replay  function that returns the last step of a trial.
/// @throws std::invalid_argument  as RunTrials.
[[nodiscard]] TrialSummary CountTrials(const TrialOptions& trials,
                                       const std::function<StepReplay(int trial)>& replay,
                                       const std::function<void(int done)>& progress = {});

/// Draw friction and mass of a trial.
[[nodiscard]] TrialFactors DrawTrialFactors(const TrialOptions& trials, int trial);

inline constexpr double kTrialConfidence = 0.95;
inline constexpr double kMostError = 1;
/// Friction and mass are positive. A tenth of the assumed value is unlikely at any allowed error.
inline constexpr double kLeastFactor = 0.1;

}  // namespace regrasp::sim
