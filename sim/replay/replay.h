#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"
#include "planner/plan/snapshot.h"
#include "sim/scene/measured.h"
#include "sim/scene/settings.h"
#include "sim/world/replay_observer.h"

namespace regrasp::sim {

/// What is measured of a step: its motion, its rest and the shakes after it.
struct StepMotion {
  plan::Reason reason = plan::Reason::kNone;
  std::string detail;         ///< for people: which finger, which direction of the shake
  plan::Fault fault;          ///< the same for a picture
  double displacement_m = 0;  ///< largest translation of the object's centroid in this step
  double rotation_deg = 0;    ///< largest rotation of the object in this step
  double moved_m = 0;         ///< largest |Δx| + R|Δrotation|, what the tolerance is about
  double give_m = 0;          ///< as moved_m, but on the servos under a push at fixed squeeze
  double slip_m = 0;          ///< largest slide of a holding fingertip along the surface
  bool contact_lost = false;  ///< a holding finger left the surface
  FingerMargins
      shake_margins;  ///< smallest cone margins (sim/world/motion_monitor.h) during the shakes
  /// The rest state after the step, or the state under the push that the grasp does not stand; no
  /// fingers where the engine came to no end.
  plan::Snapshot snapshot;
};

/// What the replay says of entry k of the report; the numbers of StepMotion are those of the
/// protocol that decides.
struct StepReplay : StepMotion {
  plan::EntryIndex index{0};
  double drift_m = 0;  ///< |Δx| + R|Δrotation| at its end since the sequence began
  AlignMode align_mode = AlignMode::kNone;
  AlignShares align_shares;      ///< as it was meant to be carried out; zero for other steps
  FingerMargins motion_margins;  ///< of fingers that hold and do not slide on purpose
  FingerMargins rest_margins;    ///< at rest after the step
  std::optional<StepMotion> adapted, fixed;  ///< of each protocol that ran
  std::optional<StepMotion> ode;             ///< by the second engine, where both were asked for
  std::vector<DirectionStress> stress;       ///< where it was asked for, in each direction
  /// Of a replay by a hand: displacement, rotation and motion are then from the planned pose.
  std::optional<HandMeasures> hand = std::nullopt;
};

struct ReplayResult {
  ReplaySettings settings;
  std::vector<StepReplay> steps;  ///< ends with the first step that fails
};

/// Replays a plan with frictional point fingers in a physics engine: holds, switches and aligns as
/// the plan says, shakes the object at every rest state along all axes, and gives a verdict.
///
/// What a pass means: with this friction, squeeze and finger model the object resisted ± shake ·
/// squeeze along every axis in every rest state of the sequence. It believes nothing of the
/// analytic check; a plan that fails the check can be replayed too.
///
/// Both engines have the same scene, script, shakes and monitor (sim/scene/engine.h is all that
/// they know of it). With EngineChoice::kBoth the result is MuJoCo's, and each entry has what ODE
/// says of it, up to the first that fails there; the observer watches MuJoCo.
///
/// Deterministic: the same plan gives the same bits.
/// @param plan   located on the object (PlanCheck::located).
/// @param steps  how many entries to replay, hold included; all where negative.
/// @throws InputError  the body cannot be simulated (scale or mass out of range).
[[nodiscard]] ReplayResult ReplayPlan(const object::Object& object, const plan::Plan& plan,
                                      const ReplayOptions& options,
                                      const ReplayObserver& observer = {}, int steps = -1);

/// The scene of the replay at rest before the initial grasp, as MJCF that stock MuJoCo loads:
/// object, collision prisms near the plan's contacts, fingers and their actuators. Numbers are
/// written with 17 digits.
[[nodiscard]] std::string SceneMjcf(const object::Object& object, const plan::Plan& plan,
                                    const ReplayOptions& options);

}  // namespace regrasp::sim
