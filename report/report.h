#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/certificate/force_proof.h"
#include "planner/grasp/finger_friction.h"
#include "planner/grasp/quality.h"
#include "planner/motion/motion_segment.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/contact_region.h"
#include "sim/replay/disagreement.h"
#include "sim/replay/replay.h"
#include "sim/replay/trials.h"
#include "sim/scene/measured.h"

namespace regrasp::report {

enum class Verdict { kPass, kFail, kSkipped };

/// "pass", "fail" or "skipped", as the report spells it.
[[nodiscard]] std::string_view VerdictName(Verdict verdict);

/// "pass", or "fail: slipped".
[[nodiscard]] std::string ReasonText(plan::Reason reason);

/// One entry of a report: the hold or a step, what the analysis and the replay say of it.
struct ReportStep {
  plan::StepCheck check;
  /// Of a switch between 2-finger grasps of a polygon that passes the analytic check.
  std::optional<plan::SwitchRegion> region;
  /// What exact arithmetic says of the proof that the plan gives for an align, if it gives one and
  /// the align passes the analytic check.
  std::optional<motion::ProofVerdict> certificate;
  std::optional<sim::StepReplay> replay;  ///< none where the analytic check failed, or when skipped
  bool skipped = false;  ///< a step before it failed, in the analysis or the replay
  std::optional<sim::NeedOfFinger> weakest_finger;  ///< of a step that passes the analytic check
  std::optional<sim::Disagreement> disagreement;    ///< between the examinations of a step
  std::optional<sim::Disagreement> engines;         ///< between the two engines, where both ran
  std::optional<certificate::EntryProof> proof;     ///< where AddProofs was asked
  std::string frame;  ///< file name of the picture, empty where there is none

  /// The analytic reason, or else that of the replay; kNone for a skipped step.
  [[nodiscard]] plan::Reason reason() const;
  [[nodiscard]] const std::string& detail() const;
  [[nodiscard]] const plan::Fault& fault() const;  ///< the detail, for a picture
  [[nodiscard]] Verdict verdict() const;
};

/// "pass", "skipped", "fail: slipped".
[[nodiscard]] std::string VerdictText(const ReportStep& step);

/// What is said of a single grasp.
struct GraspReport {
  /// Bounds on ε of the grasp (planner/grasp/quality.h); 0 where it is not force closure.
  grasp::QualityBounds quality;
  /// What each finger needs of its own friction, in the order of the file; empty where the grasp is
  /// not force closure.
  std::vector<grasp::FingerFriction> fingers;
};

/// A file, told by its content.
struct FileDigest {
  std::string name;
  std::string sha256;
};

/// What a report comes from and what stands beside it.
struct RunRecord {
  std::string sha256;             ///< of all that the report comes from
  std::vector<FileDigest> files;  ///< the other results of the same run
  std::string program = {};       ///< and its version
  std::string command = {};       ///< files and options that change the results
  std::string date = {};          ///< of the run, "2026-11-23"; on the page alone
};

/// Everything that `validate` says of a plan; report.json is this.
struct Report {
  std::string object_file, object_sha256;
  std::string plan_file, plan_sha256;  ///< or those of the grasp
  std::string planner;
  double scale = 1;
  int dimension = 3;
  std::string measures;   ///< how large and heavy the object is: "10.4 cm across, 216 g"
  double half_angle = 0;  ///< checked against, radians
  double torsion = 0;     ///< checked with, the object's unit of length (plan::Plan::torsion)
  /// Of the fingers, the object's unit of length; points where none.
  std::optional<double> finger_radius = std::nullopt;
  /// Of a plan whose contacts are at points of the object's file: the largest distance from one.
  std::optional<double> farthest_from_points = std::nullopt;
  std::optional<sim::ReplaySettings> settings;  ///< none where nothing was replayed
  std::vector<ReportStep> steps;
  /// Of a single grasp instead of a plan: the only entry is its hold.
  std::optional<GraspReport> grasp = std::nullopt;
  /// Trials with noise, if they were requested and the replay without noise passes. The plan passes
  /// if enough of them do.
  std::optional<sim::TrialSummary> trials = std::nullopt;
  std::optional<RunRecord> run = std::nullopt;  ///< none: not told

  /// Whether all steps pass, and enough trials if there are any.
  [[nodiscard]] bool passed() const;
  /// Whether all steps pass in the analysis and the replay without noise.
  [[nodiscard]] bool steps_passed() const;
  /// The step with the smallest margin to its required half-angle, the first of equal ones; not
  /// valid where no step has one.
  [[nodiscard]] plan::EntryIndex weakest_step() const;
  /// What the analytic check says of the steps; those after a failure of the replay are skipped.
  [[nodiscard]] std::vector<plan::StepCheck> checks() const;
  /// The step with the weakest finger of all (sim/measure/weakest_finger.h), the first of equal
  /// ones; not valid where no step has one.
  [[nodiscard]] plan::EntryIndex weakest_finger_step() const;
  /// For people, without a verdict: each switch whose contact region is smaller than claimed, each
  /// align whose certificate does not hold; of a replay by a hand what its verdict takes for
  /// granted (hand_limits.h).
  [[nodiscard]] std::vector<std::string> warnings() const;
};

/// Replays the first `entries` of a plan that is located, at a friction half-angle in radians.
using Replayer =
    std::function<sim::ReplayResult(const plan::Plan& located, double half_angle, int entries)>;

/// Checks a plan analytically and replays the steps that pass, up to the first that fails: a step
/// that fails the analytic check is not replayed, and what follows a failed step is skipped. Both
/// use the friction of `check` where it is given, otherwise the plan's.
///
/// Files' names and digests, and frames, are left to the caller.
/// @param replayer  replays instead of sim::ReplayPlan, where there is one; `replay` then says what
///                  the object weighs.
/// @throws InputError  the plan's dimension is not the object's, or the body cannot be simulated.
[[nodiscard]] Report Validate(const object::Object& object, const plan::Plan& plan,
                              const plan::CheckOptions& check, const sim::ReplayOptions& replay,
                              const sim::ReplayObserver& observer = {},
                              const Replayer& replayer = {});

/// Holds one grasp: the report of a plan without steps whose hand has just the fingers of the
/// grasp, numbered in its order, with what is said of a single grasp.
/// @param grasp       placed on the object, not empty.
/// @param half_angle  friction, radians.
/// @param scale       metres per unit of the object.
/// @throws InputError             the body cannot be simulated.
/// @throws std::invalid_argument  the friction half-angle is not in (0, π/2).
[[nodiscard]] Report ValidateGrasp(const object::Object& object, const grasp::Grasp& grasp,
                                   double half_angle, double scale,
                                   const sim::ReplayOptions& replay,
                                   const sim::ReplayObserver& observer = {});

/// Adds the proofs of force closure, or of its loss, of every entry that the analytic check came to
/// and that has no fault but the loss.
/// @param located  the plan that the report is about (LocatePlan).
void AddProofs(const plan::Plan& located, Report& report);

/// The plan without steps that a grasp makes: fingers are numbered in its order, the torsion is
/// that of its first contact.
[[nodiscard]] plan::Plan MakeHoldPlan(const object::Object& object, const grasp::Grasp& grasp,
                                      double half_angle, double scale);

/// The text of report.json. Beside what docs/formats.md promises it has, for each step, `detail`
/// for people, `undecided` and, for an align, how it was carried out. Bytes of file names that are
/// not UTF-8 are replaced.
[[nodiscard]] std::string FormatReportJson(const Report& report);

/// A readable table: a line per step with required half-angle, displacement, slip and verdict, and
/// the contact region in plans where a step has one, and the verdict. A plan that fails says first
/// what failed, why and what would mend it (failure.h); one that passes says what is weakest. With
/// trials the verdict names how many passed.
[[nodiscard]] std::string FormatReportTable(const Report& report);

}  // namespace regrasp::report
