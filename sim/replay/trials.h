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

/// How far off fingers are when they are put to a point of the surface.
struct ContactNoise {
  double deviation = 0;  ///< standard deviation along the surface, each direction; object's unit
  double fingertip = 0;  ///< radius of the fingertip; object's unit
};

/// The plan as a hand carries it out that puts its fingers beside where it should: every contact
/// is moved along the surface by a normal deviate in each direction of its face, straight and
/// across borders (object/surface_walk.h), so that it does not matter how small faces are. It has
/// the normal of the face that it comes to.
///
/// A finger is off by one draw as long as it is to stay at a point, through rests and aligns and
/// when its normal is to turn there; whenever it comes to another point it is drawn anew. In an
/// align it goes along the surface from one place to the next, which can add waypoints. A draw
/// where no ball of the fingertip's radius fits, or to which no way is found, is drawn again,
/// kMostNoiseDraws times at most; then the contact stays.
///
/// Deterministic; without deviation the plan as it is.
/// @param plan  located on the object (PlanCheck::located); its goal is left as it is.
[[nodiscard]] plan::Plan AddContactNoise(const object::Object& object, const plan::Plan& plan,
                                         const ContactNoise& noise, RandomStream& random);

inline constexpr int kMostNoiseDraws = 100;

/// Replays of a plan in worlds that differ a little from what the hand believes.
struct TrialOptions {
  int count = 0;
  std::uint64_t seed = 0;
  /// Standard deviation of every contact along the surface, over D: 1 mm on a body of 10 cm. The
  /// fingertips of a calibrated hand are a few millimetres off at most (3.7 mm for the DLR-Hand II:
  /// Tenhumberg, Sievers and Bäuml 2023).
  double position_noise = 0.01;
  double friction_error = 0.1;  ///< relative standard deviation of the friction coefficient
  double mass_error = 0.1;      ///< relative standard deviation of the mass
  /// Standard deviation of what a joint's angle is off from what the hand believes, radians; of
  /// replays by a hand alone (sim/actuation/hand_replay.h).
  std::optional<double> joint_noise = std::nullopt;
  /// Smallest share of trials that must pass for the plan to pass, in (0, 1].
  double min_pass_rate = 1;
};

/// The world's friction and mass over what the hand believes.
struct TrialFactors {
  double friction = 1;
  double mass = 1;
};

/// What the trials say.
struct TrialSummary {
  TrialOptions options;
  int passed = 0;
  std::map<plan::Reason, int> reasons;    ///< how many trials failed for each reason
  std::map<plan::EntryIndex, int> steps;  ///< how many failed in each entry, the first that fails

  [[nodiscard]] double share() const;
  /// Whether the share is at least `options.min_pass_rate`.
  [[nodiscard]] bool enough() const;
  /// Of the share, at kTrialConfidence.
  [[nodiscard]] ShareInterval interval() const;
};

/// Replays the plan `trials.count` times. In each trial contacts are off where the fingers were put
/// (sim/replay/trials.h), and friction and mass of the world differ from those that the hand
/// plans its forces with; it knows where its fingers touch, as in any replay. A trial passes where
/// every entry of the replay does.
///
/// Friction and mass are those believed times 1 + error · (a normal deviate), drawn again where
/// that is below kLeastFactor.
///
/// Laws: trial k depends on the seed and k alone; the same arguments give the same summary; without
/// any error every trial is the nominal replay.
/// @param plan       located on the object; its nominal replay passes.
/// @param fingertip  radius of the fingertips in the nominal replay, metres.
/// @param progress   told after every trial; may be empty.
/// @throws std::invalid_argument  a count below 1, an error or noise outside [0, kMostError].
/// @throws InputError             as ReplayPlan.
[[nodiscard]] TrialSummary RunTrials(const object::Object& object, const plan::Plan& plan,
                                     const ReplayOptions& options, const TrialOptions& trials,
                                     double fingertip,
                                     const std::function<void(int done)>& progress = {});

/// Counts what becomes of trials.
/// @param replay    a trial's last entry.
/// @throws std::invalid_argument  as RunTrials.
[[nodiscard]] TrialSummary CountTrials(const TrialOptions& trials,
                                       const std::function<StepReplay(int trial)>& replay,
                                       const std::function<void(int done)>& progress = {});

/// What RunTrials draws for a trial.
[[nodiscard]] TrialFactors DrawTrialFactors(const TrialOptions& trials, int trial);

inline constexpr double kTrialConfidence = 0.95;
inline constexpr double kMostError = 1;
/// Friction and mass are positive; a tenth of what is believed is far out at any error that is one.
inline constexpr double kLeastFactor = 0.1;

}  // namespace regrasp::sim
