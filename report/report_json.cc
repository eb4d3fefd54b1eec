#include "report/report_json.h"

#include <cmath>
#include <utility>

#include "planner/base/angle.h"
#include "planner/base/json.h"
#include "planner/certificate/plan_proof.h"
#include "report/failure.h"
#include "report/json_values.h"
#include "report/report_seal.h"
#include "report/simulation_json.h"
#include "report/stress_table.h"
#include "report/trials_report.h"
#include "sim/measure/weakest_finger.h"

namespace regrasp::report {

namespace {

Json MakeSettings(const Report& report) {
  Json settings = {{"friction_half_angle_deg", Degrees(report.half_angle)},
                   {"mu", std::tan(report.half_angle)}};
  if (report.torsion > 0) settings["torsion"] = report.torsion;
  if (report.finger_radius) settings["finger_radius"] = *report.finger_radius;
  if (!report.settings) return settings;
  const sim::ReplaySettings& replay = *report.settings;
  settings["mu"] = replay.mu;
  settings["mass_kg"] = replay.mass_kg;
  settings["squeeze_N"] = replay.squeeze_N;
  settings["squeeze_source"] = SqueezeSourceName(replay.squeeze_source);
  settings["gravity_m_s2"] = replay.gravity_m_s2;
  if (report.dimension == 2) settings["thickness_m"] = replay.thickness_m;
  settings["shake"] = replay.shake;
  settings["engine"] = EngineName(replay.engine);
  settings["protocol"] = ProtocolName(replay.protocol);
  settings["stress"] = replay.stress;
  settings["tolerance"] = replay.tolerance;
  settings["align"] = replay.align == sim::AlignChoice::kSlide ? "slide" : "imitate";
  settings["fingertip_radius_m"] = replay.fingertip_radius_m;
  settings["finger_mass_kg"] = replay.finger_mass_kg;
  settings["finger_stiffness_N_m"] = replay.finger_stiffness_N_m;
  settings["timestep_s"] = replay.timestep_s;
  if (replay.hand) settings["hand"] = HandSettingsJson(*replay.hand);
  return settings;
}

Json MakeForceClosure(const ReportStep& step) {
  if (step.check.skipped) return nullptr;
  const auto& required = step.check.required;
  return {{"holds", step.check.force_closure},
          {"required_half_angle_deg", required ? Json(Degrees(required->upper)) : Json(nullptr)}};
}

Json MakeWeakestFinger(const ReportStep& step, double half_angle) {
  if (step.skipped || !step.weakest_finger) return nullptr;
  return FingerNeedJson(step.weakest_finger->finger, step.weakest_finger->friction, half_angle);
}

/// What the plan takes as a whole: the least of every margin, and where.
Json MakeMargins(const Report& report) {
  Json finger = nullptr;
  if (const plan::EntryIndex step = report.weakest_finger_step(); step.valid()) {
    finger = MakeWeakestFinger(report.steps[step], report.half_angle);
    finger["step"] = int{step};
  }
  Json required = nullptr;
  if (const plan::EntryIndex step = report.weakest_step(); step.valid()) {
    const double angle = report.steps[step].check.required->upper;
    required = {{"step", int{step}}, {"required_half_angle_deg", Degrees(angle)}};
  }
  Json stress = nullptr;
  if (const auto weakest = FindWeakestPush(report)) {
    stress = StressJson({weakest->stress})[0];
    stress["step"] = int{weakest->step};
  }
  return {{"friction", required}, {"weakest_finger", finger}, {"stress", stress}};
}

Json MakeAlignMode(const std::optional<sim::StepReplay>& replay) {
  switch (replay ? replay->align_mode : sim::AlignMode::kNone) {
    case sim::AlignMode::kImitated:
      return "imitated";
    case sim::AlignMode::kSlid:
      return "slid";
    case sim::AlignMode::kMixed:
      return "mixed";
    default:
      return nullptr;
  }
}

Json MakeAlignShares(const std::optional<sim::StepReplay>& replay) {
  if (!replay || replay->align_mode == sim::AlignMode::kNone) return nullptr;
  const sim::AlignShares& shares = replay->align_shares;
  return {
      {"imitated", shares.imitated}, {"slid", shares.slid}, {"best_effort", shares.best_effort}};
}

/// `step` gets its contact region, if it has one.
void AddRegion(const std::optional<plan::SwitchRegion>& region, Json& step) {
  if (!region) return;
  step["region"] = {{"half_width", region->half_width},
                    {"claimed", OrNull(region->claimed)},
                    {"holds", region->holds}};
}

Json MakeCertificate(const std::optional<motion::ProofVerdict>& certificate) {
  if (!certificate) return nullptr;
  return certificate->proves() ? "holds" : "does-not-hold";
}

/// What the replay measured, where there was one.
void AddReplay(const ReportStep& step, Json& json) {
  if (!step.replay || step.skipped) return;
  json["protocols"] = ProtocolsJson(*step.replay);
  if (step.replay->ode) json["engines"] = EnginesJson(*step.replay, step.engines);
  if (!step.replay->stress.empty()) json["stress"] = StressJson(step.replay->stress);
}

Json MakeStep(const ReportStep& step, const Report& report) {
  Json json = {{"index", int{step.check.index}},
               {"kind", step.check.kind},
               {"verdict", std::string(VerdictName(step.verdict()))},
               {"reason", TextOrNull(plan::ReasonName(step.reason()))},
               {"detail", step.skipped ? Json(nullptr) : TextOrNull(step.detail())},
               {"force_closure", MakeForceClosure(step)},
               {"undecided", step.check.undecided},
               {"align_mode", MakeAlignMode(step.replay)},
               {"align_shares", MakeAlignShares(step.replay)},
               {"certificate", MakeCertificate(step.certificate)},
               {"simulation", step.replay ? SimulationJson(*step.replay) : Json(nullptr)},
               {"cause", CauseJson(step.disagreement)},
               {"weakest_finger", MakeWeakestFinger(step, report.half_angle)},
               {"frame", TextOrNull(step.frame)}};
  AddReplay(step, json);
  AddRegion(step.region, json);
  if (step.proof) json["proof"] = certificate::EntryProofJson(*step.proof, report.dimension);
  return json;
}

Json MakePlan(const Report& report) {
  if (report.grasp) return nullptr;
  Json json = {
      {"file", report.plan_file}, {"sha256", report.plan_sha256}, {"planner", report.planner}};
  if (report.farthest_from_points) {
    json["farthest_from_given_point"] = *report.farthest_from_points;
  }
  return json;
}

Json MakeGrasp(const Report& report) {
  const GraspReport& grasp = *report.grasp;
  Json fingers = Json::array();
  for (FingerIndex finger{0}; finger < std::ssize(grasp.fingers); ++finger) {
    fingers.push_back(FingerNeedJson(finger, grasp.fingers[finger], report.half_angle));
  }
  return {{"file", report.plan_file},
          {"sha256", report.plan_sha256},
          {"quality", grasp.quality.lower},
          {"quality_at_most", grasp.quality.upper},
          {"weakest_finger", IndexOrNull(grasp::WeakestFinger(grasp.fingers))},
          {"fingers", fingers}};
}

Json RunJson(const RunRecord& run) {
  Json files = Json::array();
  for (const FileDigest& file : run.files) {
    files.push_back({{"file", file.name}, {"sha256", file.sha256}});
  }
  return {{"sha256", run.sha256}, {"files", files}};
}

}  // namespace

Json ReportJson(const Report& report) {
  Json json = {{"format", "regrasp-report"},
               {"version", 1},
               {"verdict", report.passed() ? "pass" : "fail"},
               {"object",
                {{"file", report.object_file},
                 {"sha256", report.object_sha256},
                 {"scale", report.scale},
                 {"dimension", report.dimension},
                 {"measures", report.measures}}},
               {"plan", MakePlan(report)},
               {"settings", MakeSettings(report)}};
  if (report.run) json["run"] = RunJson(*report.run);
  if (report.grasp) json["grasp"] = MakeGrasp(report);
  if (report.trials) json["trials"] = TrialsJson(*report.trials);
  json["weakest_step"] = IndexOrNull(report.weakest_step());
  json["margins"] = MakeMargins(report);
  json["steps"] = Json::array();
  for (const ReportStep& step : report.steps) json["steps"].push_back(MakeStep(step, report));
  if (const auto failure = DescribeFailure(report)) {
    const bool in_step = failure->entry.valid();
    Json& failed = in_step ? json["steps"][failure->entry] : json["trials"];
    if (!in_step) failed["detail"] = failure->what;
    failed["why"] = failure->why;
    failed["mend"] = failure->mend;
  }
  return json;
}

std::string FormatReportJson(const Report& report) { return SealReport(ReportJson(report)); }

}  // namespace regrasp::report
