#include "report/report_json.h"

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/certificate/plan_proof.h"
#include "report/engine_table.h"
#include "report/failure.h"
#include "report/goal_table.h"
#include "report/report_table.h"
#include "sim/measure/disturbance.h"
#include "sim/world/motion_monitor.h"

namespace regrasp::report {

namespace {

constexpr char kRun[] = "run";
constexpr char kSeal[] = "report_sha256";

std::string Text(const Json& report) {
  // File names may be any bytes; JSON must be UTF-8.
  return report.dump(1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string SealReport(Json report) {
  if (!report.contains(kRun)) return Text(report);
  report[kRun].erase(kSeal);
  report[kRun][kSeal] = Sha256(Text(report));
  return Text(report);
}

bool IsSealed(std::string_view text) {
  Json report = ParseJson(text, "report");
  if (!report.is_object() || !report.contains(kRun) || !report[kRun].is_object()) return false;
  return SealReport(std::move(report)) == text;
}

namespace {

Json MarginOf(const sim::FingerMargins& margins, FingerIndex finger) {
  const auto found = margins.find(finger);
  return found == margins.end() ? Json(nullptr) : Json(Degrees(found->second));
}

Json FingersJson(const sim::StepReplay& replay) {
  std::set<FingerIndex> fingers;
  for (const sim::FingerMargins* margins : {&replay.static_margins, &replay.disturbance_margins}) {
    for (const auto& [finger, margin] : *margins) fingers.insert(finger);
  }
  Json json = Json::array();
  for (const FingerIndex finger : fingers) {
    json.push_back({{"finger", finger},
                    {"rest_margin_deg", MarginOf(replay.static_margins, finger)},
                    {"shake_margin_deg", MarginOf(replay.disturbance_margins, finger)}});
  }
  return json;
}

Json MotionJson(const sim::StepMotion& motion) {
  const bool passes = motion.reason == plan::Reason::kNone;
  return {{"verdict", passes ? "pass" : "fail"},
          {"reason", TextOrNull(plan::ReasonName(motion.reason))},
          {"detail", TextOrNull(motion.detail)},
          {"displacement_m", motion.displacement_m},
          {"rotation_deg", motion.rotation_deg},
          {"motion_m", motion.moved_m},
          {"give_m", motion.give_m},
          {"slip_m", motion.slip_m},
          {"contact_lost", motion.contact_lost},
          {"shake_margin_deg", DegreesOrNull(sim::SmallestMargin(motion.disturbance_margins))}};
}

Json HandJson(const sim::HandMeasures& measures) {
  return {{"rest_displacement_m", measures.rest_off_m},
          {"rest_rotation_deg", Degrees(measures.rest_off_rad)},
          {"roll_m", measures.roll_m},
          {"contact_off_m", measures.contact_off_m},
          {"torque_share", measures.torque_share},
          {"torque_Nm", measures.torque_Nm},
          {"control_limit_s", measures.control_limit_s},
          {"coupling_deg", Degrees(measures.coupling_rad)},
          {"tip_depth_m", measures.tip_depth_m},
          {"covered_depth_m", measures.covered_depth_m},
          {"frozen_displacement_m", measures.frozen_off_m},
          {"frozen_rotation_deg", Degrees(measures.frozen_off_rad)},
          {"grasp_force_N", measures.grasp_force_N},
          {"simulated_s", measures.simulated_s}};
}

Json LimitsJson(const std::vector<sim::DriveLimits>& limits) {
  Json json = Json::array();
  for (const sim::DriveLimits& limit : limits) {
    json.push_back(
        {{"finger", int{limit.finger}},
         {"joint", limit.joint},
         {"actuator", limit.actuator},
         {"torque_Nm", std::isfinite(limit.torque_Nm) ? Json(limit.torque_Nm) : Json(nullptr)},
         {"control", OrNull(limit.control)},
         {"range_deg", {Degrees(limit.lower_rad), Degrees(limit.upper_rad)}}});
  }
  return json;
}

}  // namespace

const char* ProtocolName(sim::Protocol protocol) {
  switch (protocol) {
    case sim::Protocol::kAdapted:
      return "adapted";
    case sim::Protocol::kFixed:
      return "fixed";
    case sim::Protocol::kBoth:
      return "both";
  }
  return "";
}

const char* EngineName(sim::EngineChoice engine) {
  switch (engine) {
    case sim::EngineChoice::kMujoco:
      return "mujoco";
    case sim::EngineChoice::kOde:
      return "ode";
    case sim::EngineChoice::kBoth:
      return "both";
  }
  return "";
}

const char* GraspForceSourceName(sim::GraspForceSource source) {
  switch (source) {
    case sim::GraspForceSource::kDisturbance:
      return "shake";
    case sim::GraspForceSource::kHand:
      return "hand";
    case sim::GraspForceSource::kTorques:
      return "torques";
    case sim::GraspForceSource::kGiven:
      return "option";
  }
  return "";
}

Json HandSettingsJson(const sim::HandReplaySettings& settings) {
  return {
      {"tolerance_m", settings.tolerance.length_m},
      {"tolerance_deg", Degrees(settings.tolerance.angle_rad)},
      {"tolerance_at_rest", settings.tolerance.at_rest},
      {"slip_m", settings.tolerance.slip_m},
      {"lost_s", settings.tolerance.lost_s},
      {"limit_s", settings.tolerance.limit_s},
      {"joint_deg", Degrees(settings.tolerance.joint_rad)},
      {"depth_m", settings.tolerance.depth_m},
      {"frozen_m", settings.tolerance.frozen_m},
      {"frozen_deg", Degrees(settings.tolerance.frozen_rad)},
      {"feedback", settings.sensing.feedback == sim::PoseFeedback::kPose ? "pose" : "none"},
      {"pose_delay_s", settings.sensing.pose_delay_s},
      {"pose_rate_Hz", settings.sensing.pose_rate_Hz},
      {"pose_noise_m", settings.sensing.pose_noise_m},
      {"pose_noise_deg", Degrees(settings.sensing.pose_noise_rad)},
      {"pose_bias_m", settings.sensing.pose_bias_m},
      {"pose_bias_deg", Degrees(settings.sensing.pose_bias_rad)},
      {"tip", settings.tip == sim::TipShape::kBall ? "ball" : "geometry"},
      {"servo_stiffness_Nm_rad", {settings.least_stiffness, settings.largest_stiffness}},
      {"derived_servos", settings.derived_servos},
      {"model_stiffness_Nm_rad", settings.soft_stiffness ? Json(*settings.soft_stiffness) : Json()},
      {"limits", LimitsJson(settings.limits)}};
}

Json SimulationJson(const sim::StepReplay& replay) {
  Json json = {{"displacement_m", replay.displacement_m},
               {"rotation_deg", replay.rotation_deg},
               {"motion_m", replay.moved_m},
               {"slip_m", replay.slip_m},
               {"contact_lost", replay.contact_lost},
               {"cone_margin_deg",
                {{"motion", DegreesOrNull(sim::SmallestMargin(replay.motion_margins))},
                 {"rest", DegreesOrNull(sim::SmallestMargin(replay.static_margins))},
                 {"shakes", DegreesOrNull(sim::SmallestMargin(replay.disturbance_margins))}}},
               {"fingers", FingersJson(replay)}};
  if (replay.hand) json["hand"] = HandJson(*replay.hand);
  return json;
}

Json ProtocolsJson(const sim::StepReplay& replay) {
  Json json = Json::object();
  if (replay.adapted) json["adapted"] = MotionJson(*replay.adapted);
  if (replay.fixed) json["fixed"] = MotionJson(*replay.fixed);
  return json;
}

Json ResistedWrenchesJson(const std::vector<sim::ResistedWrench>& resisted_wrench) {
  Json json = Json::array();
  for (const sim::ResistedWrench& direction : resisted_wrench) {
    json.push_back({{"direction", sim::DisturbanceName(direction.disturbance)},
                    {"replay", direction.replay},
                    {"analysis", direction.analysis}});
  }
  return json;
}

Json CauseJson(const std::optional<sim::Disagreement>& disagreement) {
  if (!disagreement) return nullptr;
  Json values = Json::object();
  for (const auto& [name, value] : disagreement->values) values[name] = value;
  return {{"between", std::string(sim::BetweenName(disagreement->between))},
          {"cause", std::string(sim::CauseName(disagreement->cause))},
          {"text", disagreement->text},
          {"values", values}};
}

Json EnginesJson(const sim::StepReplay& replay, const std::optional<sim::Disagreement>& between) {
  return {{"mujoco", MotionJson(replay)},
          {"ode", MotionJson(*replay.ode)},
          {"cause", CauseJson(between)}};
}

Json FingerNeedJson(FingerIndex finger, const grasp::FingerFriction& friction,
                    double friction_angle) {
  return {{"finger", finger},
          {"needed", friction.needed},
          {"required_half_angle_deg", Degrees(friction.required)},
          {"margin_deg", Degrees(friction_angle - friction.required)},
          {"without_half_angle_deg", DegreesOrNull(friction.without)}};
}

namespace {

Json MakeSettings(const Report& report) {
  Json settings = {{"friction_half_angle_deg", Degrees(report.friction_angle)},
                   {"mu", std::tan(report.friction_angle)}};
  if (report.torsion > 0) settings["torsion"] = report.torsion;
  if (report.finger_radius) settings["finger_radius"] = *report.finger_radius;
  if (!report.settings) return settings;
  const sim::ReplaySettings& replay = *report.settings;
  settings["mu"] = replay.mu;
  settings["mass_kg"] = replay.mass_kg;
  settings["squeeze_N"] = replay.grasp_force_N;
  settings["squeeze_source"] = GraspForceSourceName(replay.grasp_force_source);
  settings["gravity_m_s2"] = replay.gravity_m_s2;
  if (report.dimension == 2) settings["thickness_m"] = replay.thickness_m;
  settings["shake"] = replay.disturbance_ratio;
  settings["engine"] = EngineName(replay.engine);
  settings["protocol"] = ProtocolName(replay.protocol);
  settings["stress"] = replay.resisted_wrench;
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
  Json json = {
      {"holds", step.check.force_closure},
      {"required_half_angle_deg", required ? Json(Degrees(required->upper)) : Json(nullptr)}};
  if (step.check.is_supported) {
    json["gravity_supported"] = {{"static_grasp", step.check.ends_supported},
                                 {"resistance_weights", OrNull(step.check.resistance)}};
  }
  return json;
}

Json MakeWeakestFinger(const ReportStep& step, double friction_angle) {
  if (step.skipped || !step.weakest_finger) return nullptr;
  return FingerNeedJson(step.weakest_finger->finger, step.weakest_finger->friction, friction_angle);
}

/// Return the smallest margin of each kind over the whole plan, with its place.
Json MakeMargins(const Report& report) {
  Json finger = nullptr;
  if (const plan::EntryIndex step = report.weakest_finger_step(); step.valid()) {
    finger = MakeWeakestFinger(report.steps[step], report.friction_angle);
    finger["step"] = int{step};
  }
  Json required = nullptr;
  if (const plan::EntryIndex step = report.weakest_step(); step.valid()) {
    const double angle = report.steps[step].check.required->upper;
    required = {{"step", int{step}}, {"required_half_angle_deg", Degrees(angle)}};
  }
  Json resisted_wrench = nullptr;
  if (const auto weakest = FindWeakestDisturbance(report)) {
    resisted_wrench = ResistedWrenchesJson({weakest->resisted_wrench})[0];
    resisted_wrench["step"] = int{weakest->step};
  }
  return {{"friction", required}, {"weakest_finger", finger}, {"stress", resisted_wrench}};
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

/// Add the contact region of a step, if there is one.
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

/// Add the measurements of the replay, if there was one.
void AddReplay(const ReportStep& step, Json& json) {
  if (!step.replay || step.skipped) return;
  json["protocols"] = ProtocolsJson(*step.replay);
  if (step.replay->ode) json["engines"] = EnginesJson(*step.replay, step.engines);
  if (!step.replay->resisted_wrench.empty())
    json["stress"] = ResistedWrenchesJson(step.replay->resisted_wrench);
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
               {"weakest_finger", MakeWeakestFinger(step, report.friction_angle)},
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
    fingers.push_back(FingerNeedJson(finger, grasp.fingers[finger], report.friction_angle));
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
  if (report.conditions) json["conditions"] = ConditionsJson(*report.conditions);
  if (!report.goals.empty()) json["goals"] = GoalsJson(report.goals);
  const std::vector<validation::EngineResult> engines = validation::EngineResultsOf(report);
  if (!engines.empty()) json["engines"] = EngineResultsJson(engines);
  json["weakest_step"] = IndexOrNull(report.weakest_step());
  json["margins"] = MakeMargins(report);
  json["steps"] = Json::array();
  for (const ReportStep& step : report.steps) json["steps"].push_back(MakeStep(step, report));
  if (const auto failure = DescribeFailure(report)) {
    const bool in_step = failure->entry.valid();
    Json& failed = in_step ? json["steps"][failure->entry] : json[failure->kind];
    if (!in_step) failed["detail"] = failure->what;
    failed["why"] = failure->why;
    failed["mend"] = failure->suggested_fix;
  }
  return json;
}

std::string FormatReportJson(const Report& report) { return SealReport(ReportJson(report)); }

}  // namespace regrasp::report
