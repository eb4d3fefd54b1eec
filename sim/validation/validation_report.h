#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/certificate/force_proof.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/motion/motion_segment.h"
#include "planner/plan/check.h"
#include "planner/plan/contact_region.h"
#include "sim/actuation/condition_replays.h"
#include "sim/replay/disagreement.h"
#include "sim/replay/replay.h"
#include "sim/replay/trials.h"
#include "sim/scene/measured.h"
#include "sim/validation/goal_report.h"

namespace regrasp::validation {

enum class Verdict { kPass, kFail, kSkipped };

/// The results of the analytic check and of the replay for one step; step 0 is the initial grasp.
struct ReportStep {
  plan::StepCheck check;
  /// Contact region of a switch between 2-finger grasps of a polygon that passes the check.
  std::optional<plan::SwitchRegion> region;
  /// Result of the exact check of the certificate that the plan gives for a sliding step; nullopt
  /// if it gives none or the step fails the analytic check.
  std::optional<motion::ProofVerdict> certificate;
  std::optional<sim::StepReplay> replay;  ///< nullopt if the step fails the check or is skipped
  bool skipped = false;                   ///< whether an earlier step failed
  std::optional<sim::NeedOfFinger> weakest_finger;  ///< nullopt if the step fails the check
  std::optional<sim::Disagreement> disagreement;    ///< between the check and the replay protocols
  std::optional<sim::Disagreement> engines;         ///< between two engines, if both ran
  std::optional<certificate::EntryProof> proof;     ///< proof, with ValidationOptions::certificates
  std::string frame;                                ///< file name of the image; empty: none

  /// Return the reason of the analytic check or, if it passes, of the replay.
  /// A skipped step has none.
  [[nodiscard]] plan::Reason reason() const;
  [[nodiscard]] const std::string& detail() const;
  [[nodiscard]] const plan::Fault& fault() const;  ///< location of the fault, for an image
  [[nodiscard]] Verdict verdict() const;
};

/// Results for a single grasp.
struct GraspReport {
  /// Bounds on the quality ε (planner/grasp/quality.h); 0 if the grasp is not force closure.
  grasp::QualityBounds quality;
  /// Required friction of each finger, in file order; empty if the grasp is not force closure.
  std::vector<grasp::FingerFriction> fingers;
};

/// A file, identified by its content.
struct FileDigest {
  std::string name;
  std::string sha256;
};

/// Inputs and other result files of the run that made a report. Set by the caller of Validate.
struct RunRecord {
  std::string sha256;             ///< digest of all inputs
  std::vector<FileDigest> files;  ///< other results of the same run
  std::string program = {};       ///< name and version
  std::string command = {};       ///< files and options that change the results
  std::string date = {};          ///< "2026-11-23"; only the HTML report shows it
};

/// The result of a validation; report.json contains the same data.
struct Report {
  std::string object_file, object_sha256;
  std::string plan_file, plan_sha256;  ///< file and SHA-256 of the plan or the grasp
  std::string planner;
  double scale = 1;  ///< metres per unit of length of the object
  int dimension = 3;
  std::string measures;  ///< size and mass of the object: "10.4 cm across, 216 g"
  /// Whether the object's file states no unit of length, so that its numbers times `scale` are
  /// metres.
  bool has_no_unit = false;
  double friction_angle = 0;  ///< friction angle, radians
  double torsion = 0;         ///< torsional friction length, unit of the object
  /// Radius of the fingers, unit of the object; nullopt: points.
  std::optional<double> finger_radius = std::nullopt;
  /// Largest distance of a contact from the points that the object's file gives; nullopt if the
  /// plan is not at such points.
  std::optional<double> farthest_from_points = std::nullopt;
  std::optional<sim::ReplaySettings> settings;  ///< nullopt if nothing was replayed
  std::vector<ReportStep> steps;
  /// Set for a single grasp, which has only step 0.
  std::optional<GraspReport> grasp = std::nullopt;
  /// Trials with noise, if they were requested and the replay without noise passes. The plan passes
  /// if enough of them pass.
  std::optional<sim::TrialSummary> trials = std::nullopt;
  /// Replays under other conditions, if they were requested and all steps pass the analytic check.
  std::optional<sim::ConditionSummary> conditions = std::nullopt;
  /// Goals that the plan marks, if its hand was checked.
  std::vector<GoalReport> goals = {};
  std::optional<RunRecord> run = std::nullopt;

  /// Return whether all steps pass, and enough trials and conditions if there are any.
  [[nodiscard]] bool passed() const;
  /// Return whether all steps pass in the analytic check and the replay without noise.
  [[nodiscard]] bool steps_passed() const;
  /// Return the first step with the largest required friction angle; not valid if no step has one.
  [[nodiscard]] plan::EntryIndex weakest_step() const;
  /// Return the results of the analytic check; steps after a failure in the replay are skipped.
  [[nodiscard]] std::vector<plan::StepCheck> checks() const;
  /// Return the first step with the weakest finger of all (sim/measure/disturbance.h).
  /// It is not valid if no step has one.
  [[nodiscard]] plan::EntryIndex weakest_finger_step() const;
};

}  // namespace regrasp::validation
