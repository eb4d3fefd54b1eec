#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"
#include "sim/actuation/conditions.h"
#include "sim/actuation/hand_replay.h"
#include "sim/hand/check_hand.h"
#include "sim/replay/trials.h"
#include "sim/scene/settings.h"
#include "sim/validation/validation_report.h"
#include "sim/world/replay_observer.h"

namespace regrasp::validation {

/// Options of a validation. Without a value the plan's value applies.
struct ValidationOptions {
  std::optional<double> friction_angle;  ///< friction angle, radians
  std::optional<double> torsion;         ///< torsional friction length, unit of the object; 0: none
  bool allow_undecided = false;          ///< plan::CheckOptions::allow_undecided
  bool certificates = false;  ///< whether to find a proof of each statement on force closure
  /// Settings of the replay by point fingers. Its ReplayConditions hold for a hand, too.
  sim::ReplayOptions replay;
  bool replay_by_hand = true;        ///< whether the hand's actuators execute the plan, if any
  sim::HandReplayOptions hand;       ///< settings of that replay, except ReplayConditions
  sim::HandCheckOptions hand_check;  ///< settings of the analytic check of the hand
  sim::TrialOptions trials;          ///< trials with noise; a count of 0: none
  std::vector<sim::HandCondition> conditions;  ///< conditions of further replays by the hand
  /// share of the conditions that must pass; nullopt: their results are information
  std::optional<double> required_conditions;
  int condition_jobs = 1;  ///< number of threads of these replays
};

/// A plan or a grasp to validate. All references and pointers must outlive the validation.
struct ValidationRequest {
  const object::Object& object;
  const plan::Plan& plan;
  bool is_grasp = false;  ///< whether the plan is MakeHoldPlan of a single grasp
  const kinematics::HandFile* hand = nullptr;  ///< the plan's hand; null: is not checked
  const grasp::Grasp* start = nullptr;         ///< required initial grasp; null: any
  const grasp::Grasp* goal = nullptr;          ///< required goal; null: any
  const std::vector<Eigen::Vector3d>* given_points = nullptr;  ///< plan::CheckOptions::given_points
  ValidationOptions options = {};
  std::string plan_name = "plan";  ///< name in messages
};

/// Callbacks during a validation; all may be empty.
struct ValidationObserver {
  /// Called with a line of text: "checking the plan", "replay: 3 of 7 steps".
  std::function<void(const std::string&)> on_stage = {};
  sim::ReplayObserver replay = {};  ///< observer of the replay without noise
};

/// The values that a validation runs with, resolved once from the request.
struct ValidationSettings {
  /// The plan with the friction angle, torsional friction length and finger radius of the
  /// validation. In a ValidationResult also located on the object.
  plan::Plan plan;
  plan::CheckOptions check;
  sim::ReplayOptions replay;
  /// Settings of the replay by the hand; nullopt: point fingers execute the plan.
  std::optional<sim::HandReplayOptions> hand = std::nullopt;
};

/// A report and the settings that it was made with.
struct ValidationResult {
  ValidationSettings settings;
  Report report;
};

/// Resolve the settings of a request.
[[nodiscard]] ValidationSettings ResolveSettings(const ValidationRequest& request);

/// Validate a plan or a grasp.
/// It checks the hand, checks the plan analytically, and replays it up to the first failure. If the
/// replay passes, it runs trials with noise. If the analytic check passes, it replays the plan by a
/// hand under the conditions.
///
/// A step that fails the analytic check is not replayed, and steps after a failure are skipped. The
/// caller sets names and digests of files, the run record and names of images in the report.
/// @throws InputError             if the plan's dimension is not the object's, the plan is not for
///                                this hand, or object or hand cannot be simulated.
/// @throws std::invalid_argument  if the friction angle is not in (0, π/2).
///
///     const auto result = validation::Validate({.object = cube, .plan = plan});
///     if (!result.report.passed()) std::cout << report::FormatReportTable(result.report);
[[nodiscard]] ValidationResult Validate(const ValidationRequest& request,
                                        const ValidationObserver& observer = {});

/// Return the plan without steps that holds one grasp.
/// Fingers have the numbers of the contacts. The torsional friction length is that of the first
/// contact.
/// @param friction_angle  friction angle, radians.
/// @param scale       metres per unit of the object.
[[nodiscard]] plan::Plan MakeHoldPlan(const object::Object& object, const grasp::Grasp& grasp,
                                      double friction_angle, double scale);

}  // namespace regrasp::validation
