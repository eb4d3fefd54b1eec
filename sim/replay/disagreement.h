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

/// Two examinations of one step that say different things.
enum class Between {
  kReplayFails,    ///< the analysis passes the step, the replay fails it
  kAnalysisFails,  ///< the other way round, where someone replays what the analysis fails
  kFixedFails,     ///< adapted forces resist the shake, a fixed squeeze does not
  kOdeFails,       ///< MuJoCo passes the step, ODE fails it
  kOdePasses,      ///< the other way round
};

/// What is likely behind it, in the order in which it is looked for.
enum class Cause {
  kConcaveCorner,     ///< a contact where no fingertip fits
  kNoClearance,       ///< a fingertip thicker than the clearance of its contact
  kWeight,            ///< the squeeze does not carry the weight, or not besides the shake
  kQuality,           ///< quality ε below the shake
  kEdge,              ///< a contact nearer to its face's border than a finger may slip
  kConeReached,       ///< a finger's force reached its friction cone
  kNotSimulated,      ///< the analytic fault is none that a replay looks at
  kNoShake,           ///< a replay without shake: the weight alone does not test the grasp
  kCriticalFriction,  ///< friction within 2 % of the critical one
  kUnstable,          ///< one of two engines did not come through
  kUnknown,           ///< none of these
};

/// A disagreement and its likely cause, with the numbers that speak for it.
struct Disagreement {
  Between between = Between::kReplayFails;
  Cause cause = Cause::kUnknown;
  std::string text = {};  ///< for people, one phrase
  /// Names as in report.json; lengths in metres, angles in degrees, loads over the squeeze.
  std::vector<std::pair<std::string, double>> values = {};
};

/// A step and what was found of it.
struct ExaminedStep {
  const object::Object& object;
  const plan::Plan& located;  ///< contacts on the surface (PlanCheck::located)
  const plan::StepCheck& check;
  const StepReplay& replay;
  const ReplaySettings& settings;
};

/// Compares what the analysis, the replay and its two protocols say of a step; nullopt where they
/// agree. Geometry comes before loads, and loads before what was measured: a finger that has no
/// clearance slips too, and a grasp that is too weak reaches its cones.
[[nodiscard]] std::optional<Disagreement> ExplainDisagreement(const ExaminedStep& step);

/// Compares what the two engines say of a step that both replayed; nullopt where they agree, or
/// where both have not replayed it. Friction within kNearCriticalOfTwo of the critical one comes
/// first: there it is rounding that decides; then what makes a replay fail.
[[nodiscard]] std::optional<Disagreement> ExplainEngines(const ExaminedStep& step);

/// "likely cause: the quality is below the shake: …", or that none was found.
[[nodiscard]] std::string LikelyCauseText(const Disagreement& found);

/// "replay-fails" and so on, as the report spells it.
[[nodiscard]] std::string_view BetweenName(Between between);
/// "quality-below-shake" and so on, as the report spells it.
[[nodiscard]] std::string_view CauseName(Cause cause);

/// Friction over the critical one (of μ) up to which a grasp that is not force closure can stand a
/// replay: none at or below 0.98 did in 2000.
inline constexpr double kNearCritical = 0.98;
/// Two engines may differ about a grasp whose friction is as near to the critical one, relatively.
inline constexpr double kNearCriticalOfTwo = 0.02;

}  // namespace regrasp::sim
