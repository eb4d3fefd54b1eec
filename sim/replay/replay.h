#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/projection.h"
#include "planner/plan/reason.h"
#include "sim/scene/measured.h"
#include "sim/scene/settings.h"
#include "sim/world/replay_observer.h"

namespace regrasp::sim {

/// Measurements of a step: its motion, its static grasp and the disturbance test after it.
struct StepMotion : Violation {
  double displacement_m = 0;          ///< largest translation of the object's centroid in this step
  double rotation_deg = 0;            ///< largest rotation of the object in this step
  double moved_m = 0;                 ///< largest |Δx| + R|Δrotation|, which the tolerance limits
  double give_m = 0;                  ///< compliance displacement: the same in the fixed response
  double slip_m = 0;                  ///< largest slide of a holding fingertip along the surface
  bool contact_lost = false;          ///< whether a holding finger left the surface
  FingerMargins disturbance_margins;  ///< smallest friction margins in the disturbance test
  /// The static grasp after the step, or the state under the disturbance that the grasp does not
  /// withstand. Without fingers if the simulation diverges.
  plan::Snapshot snapshot;
};

/// Results of one step in the replay.
/// The numbers of StepMotion are those of the protocol that decides.
struct StepReplay : StepMotion {
  plan::EntryIndex index{0};
  /// |Δx| + R|Δrotation| from the start of the sequence to the end of the step
  double drift_m = 0;
  AlignMode align_mode = AlignMode::kNone;
  AlignShares align_shares;  ///< planned shares; zero for other steps
  /// friction margins of holding fingers that do not slide on purpose
  FingerMargins motion_margins;
  FingerMargins static_margins;  ///< friction margins in the static grasp after the step
  std::optional<StepMotion> adapted, fixed;  ///< results of each protocol that ran
  std::optional<StepMotion> ode;  ///< results of the second engine, with EngineChoice::kBoth
  /// resisted wrench in each direction, with ReplayOptions::resisted_wrench
  std::vector<ResistedWrench> resisted_wrench;
  /// Measurements of a replay by a hand. If set, displacement, rotation and motion are relative to
  /// the planned pose.
  std::optional<HandMeasures> hand = std::nullopt;
  std::optional<HandMeasures> ode_hand = std::nullopt;  ///< hand measures in `ode`
};

struct ReplayResult {
  ReplaySettings settings;
  std::vector<StepReplay> steps;  ///< ends with the first step that fails
};

/// Replay a plan with frictional point fingers in a physics engine.
/// It executes the steps of the plan. In every static grasp it applies disturbance forces along all
/// axes and torques about them.
///
/// A pass is a statement about this friction, grasp force and finger model: the object withstands ±
/// ρ · grasp force along every axis in every static grasp. The replay uses no result of the
/// analytic check. A plan that fails the check can be replayed, too.
///
/// Both engines have the same scene, script, disturbance tests and monitor, and know only
/// sim/scene/engine.h. With EngineChoice::kBoth the result is MuJoCo's. Each step also has that of
/// ODE, up to the first that fails there. The observer watches MuJoCo.
///
/// Deterministic: the same plan gives the same bits.
/// @param plan   plan located on the object (PlanCheck::projected).
/// @param steps  number of steps to replay, initial grasp included; negative: all.
/// @throws InputError  if the body cannot be simulated (scale or mass out of range).
[[nodiscard]] ReplayResult ReplayPlan(const object::Object& object, const plan::Plan& plan,
                                      const ReplayOptions& options,
                                      const ReplayObserver& observer = {}, int steps = -1);

/// Format the scene of the replay before the initial grasp, as MJCF that stock MuJoCo loads:
/// object, collision prisms near the plan's contacts, fingers and their actuators. Numbers are
/// written with 17 digits.
[[nodiscard]] std::string SceneMjcf(const object::Object& object, const plan::Plan& plan,
                                    const ReplayOptions& options);

}  // namespace regrasp::sim
