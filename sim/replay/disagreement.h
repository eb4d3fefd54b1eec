#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "sim/replay/replay.h"

namespace regrasp::sim {

/// Two examinations of one step with different results.
enum class Between {
  kReplayFails,    ///< the analysis passes the step, the replay fails it
  kAnalysisFails,  ///< the analysis fails the step, the replay passes it
  kFixedFails,     ///< adapted forces resist the disturbance test, a fixed grasp force does not
  kOdeFails,       ///< MuJoCo passes the step, ODE fails it
  kOdePasses,      ///< MuJoCo fails the step, ODE passes it
};

/// Likely cause of a disagreement, in the order in which causes are checked.
enum class Cause {
  kConcaveCorner,  ///< a contact at which no fingertip fits
  kNoClearance,    ///< a fingertip thicker than the clearance of its contact
  kWeight,        ///< the grasp force does not support the weight, alone or in the disturbance test
  kQuality,       ///< grasp quality ε below ρ
  kEdge,          ///< a contact closer to the border of its face than the slip limit
  kConeReached,   ///< a finger's force reached its friction cone
  kNotSimulated,  ///< an analytic fault that a replay does not check
  kNoDisturbance,  ///< a replay without disturbance test: the weight alone does not test the grasp
  kRequiredFriction,  ///< friction within 2 % of the required friction
  kUnstable,          ///< an unstable simulation in one of the two engines
  kUnknown,           ///< none of these
};

/// A disagreement and its likely cause, with the numbers that support it.
struct Disagreement {
  Between between = Between::kReplayFails;
  Cause cause = Cause::kUnknown;
  std::string text = {};  ///< readable description, one phrase
  /// Names as in report.json; lengths in metres, angles in degrees, loads over the grasp force.
  std::vector<std::pair<std::string, double>> values = {};
};

/// A step and its results.
struct ExaminedStep {
  const object::Object& object;
  const plan::Plan& projected;  ///< contacts on the surface (PlanCheck::projected)
  const plan::StepCheck& check;
  const StepReplay& replay;
  const ReplaySettings& settings;
};

/// Compare the analysis, the replay and its two protocols on a step.
/// Geometry is checked first, then loads, then measurements. A finger without clearance slips too,
/// and a grasp that is too weak reaches its friction cones.
/// @returns the disagreement; nullopt if all agree.
[[nodiscard]] std::optional<Disagreement> ExplainDisagreement(const ExaminedStep& step);

/// Compare the results of the two engines on a step.
/// Friction within kNearCriticalOfTwo of the required friction is checked first, because rounding
/// decides there. The causes of a failed replay follow, except for a hand, for which none are
/// known.
/// @returns the disagreement; nullopt if the engines agree, or if only one replayed the step.
[[nodiscard]] std::optional<Disagreement> ExplainEngines(const ExaminedStep& step);

/// Return the likely cause as text, or that none was found.
[[nodiscard]] std::string LikelyCauseText(const Disagreement& found);

/// Return the name in the report, such as "replay-fails".
[[nodiscard]] std::string_view BetweenName(Between between);
/// Return the name in the report, such as "quality-below-shake".
[[nodiscard]] std::string_view CauseName(Cause cause);

/// Largest ratio of friction to required friction (of μ) at which a grasp cannot pass a replay.
/// None of 2000 grasps that are not force closure passed at or below 0.98.
inline constexpr double kNearCritical = 0.98;
/// Relative distance to the required friction within which two engines may differ.
inline constexpr double kNearCriticalOfTwo = 0.02;

}  // namespace regrasp::sim
