#include "report/report.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/base/limit_text.h"
#include "planner/base/number.h"
#include "planner/certificate/align_certificate.h"
#include "planner/certificate/plan_proof.h"
#include "planner/grasp/bound_quality.h"
#include "planner/object/polygon.h"
#include "report/hand_limits.h"
#include "sim/measure/weakest_finger.h"
#include "sim/scene/scaling.h"

namespace regrasp::report {

namespace {

/// How many steps from the first on pass the analytic check.
int CountPassing(const std::vector<plan::StepCheck>& steps) {
  const auto fails = [](const plan::StepCheck& step) {
    return step.skipped || step.reason != plan::Reason::kNone;
  };
  return static_cast<int>(std::find_if(steps.begin(), steps.end(), fails) - steps.begin());
}

void TakeReplay(sim::ReplayResult result, Report& report) {
  report.settings = result.settings;
  for (sim::StepReplay& step : result.steps) {
    report.steps[step.index].replay = std::move(step);
  }
}

/// Contact regions are measured for switches that are known to be right.
void MeasureRegions(const object::Object& object, const plan::Plan& located, int count,
                    Report& report) {
  const auto* polygon = dynamic_cast<const object::Polygon*>(&object);
  if (polygon == nullptr) return;
  plan::FingerGrasp before = located.initial;
  for (plan::EntryIndex index{1}; index < count; ++index) {
    const plan::Step& step = plan::StepOf(located, index);
    if (const auto* change = std::get_if<plan::Switch>(&step)) {
      report.steps[index].region =
          plan::MeasureSwitchRegion(*polygon, before, *change, report.half_angle);
    }
    before = plan::GraspAfter(before, step);
  }
}

/// Certificates are checked of aligns that are known to be right.
void CheckCertificates(const plan::Plan& located, int count, Report& report) {
  for (plan::EntryIndex index{1}; index < count; ++index) {
    const auto* align = std::get_if<plan::Align>(&plan::StepOf(located, index));
    if (align == nullptr || !align->certificate) continue;
    report.steps[index].certificate = certificate::CheckAlignCertificate(
        *align, report.dimension, std::tan(report.half_angle), *align->certificate);
  }
}

/// Which finger is the weakest, and why examinations disagree, of the steps that pass the analysis.
void ExamineSteps(const object::Object& object, const plan::Plan& located, int count,
                  Report& report) {
  sim::WeakestFingers fingers(located, object.wrench_frame(), report.half_angle);
  for (plan::EntryIndex index{0}; index < count; ++index) {
    ReportStep& step = report.steps[index];
    step.weakest_finger = fingers.OfEntry(index);
    // What is known of likely causes is known of ideal fingers.
    if (!step.replay || report.settings->hand) continue;
    step.disagreement =
        sim::ExplainDisagreement({object, located, step.check, *step.replay, *report.settings});
    step.engines =
        sim::ExplainEngines({object, located, step.check, *step.replay, *report.settings});
  }
}

/// What follows the first failure is skipped, whoever found it.
void SkipAfterFailure(std::vector<ReportStep>& steps) {
  bool failed = false;
  for (ReportStep& step : steps) {
    step.skipped = failed || step.check.skipped;
    failed = failed || step.reason() != plan::Reason::kNone;
    // Nothing passes that was not replayed.
    if (!failed && !step.replay) throw std::logic_error("the replay left out a step");
  }
}

}  // namespace

std::string_view VerdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kFail:
      return "fail";
    case Verdict::kSkipped:
      return "skipped";
  }
  return "";
}

std::string ReasonText(plan::Reason reason) {
  return reason == plan::Reason::kNone ? "pass" : "fail: " + std::string(plan::ReasonName(reason));
}

std::string VerdictText(const ReportStep& step) {
  return step.skipped ? "skipped" : ReasonText(step.reason());
}

plan::Reason ReportStep::reason() const {
  if (skipped) return plan::Reason::kNone;
  if (check.reason != plan::Reason::kNone) return check.reason;
  return replay ? replay->reason : plan::Reason::kNone;
}

const std::string& ReportStep::detail() const {
  return replay && check.reason == plan::Reason::kNone ? replay->detail : check.detail;
}

const plan::Fault& ReportStep::fault() const {
  return replay && check.reason == plan::Reason::kNone ? replay->fault : check.fault;
}

Verdict ReportStep::verdict() const {
  if (skipped) return Verdict::kSkipped;
  return reason() == plan::Reason::kNone ? Verdict::kPass : Verdict::kFail;
}

bool Report::passed() const { return steps_passed() && (!trials || trials->enough()); }

bool Report::steps_passed() const {
  return std::all_of(steps.begin(), steps.end(),
                     [](const ReportStep& step) { return step.verdict() == Verdict::kPass; });
}

plan::EntryIndex Report::weakest_step() const { return plan::WeakestStep(checks()); }

std::vector<plan::StepCheck> Report::checks() const {
  std::vector<plan::StepCheck> checks;
  for (const ReportStep& step : steps) {
    checks.push_back(step.check);
    checks.back().skipped = step.skipped;
  }
  return checks;
}

plan::EntryIndex Report::weakest_finger_step() const {
  std::vector<grasp::FingerFriction> weakest;
  std::vector<plan::EntryIndex> index;
  for (const ReportStep& step : steps) {
    if (step.skipped || !step.weakest_finger) continue;
    weakest.push_back(step.weakest_finger->friction);
    index.push_back(step.check.index);
  }
  const int found = grasp::WeakestFinger(weakest);
  return found < 0 ? plan::EntryIndex() : index[found];
}

std::vector<std::string> Report::warnings() const {
  std::vector<std::string> warnings;
  for (const ReportStep& step : steps) {
    const std::string name = "step " + std::to_string(step.check.index);
    if (step.region && !step.region->holds) {
      const auto [width, claimed] =
          FormatWithLimit(step.region->half_width, *step.region->claimed, 4);
      warnings.push_back(name + ": the plan claims a contact region of " + claimed +
                         ", but it is " + width);
    }
    if (step.certificate && !step.certificate->proves()) {
      warnings.push_back(name + ": the plan's certificate is not valid: " + step.certificate->why);
    }
  }
  AddHandWarnings(*this, warnings);
  return warnings;
}

Report Validate(const object::Object& object, const plan::Plan& plan,
                const plan::CheckOptions& check, const sim::ReplayOptions& replay,
                const sim::ReplayObserver& observer, const Replayer& replayer) {
  const plan::PlanCheck checked = plan::CheckPlan(object, plan, check);
  Report report;
  report.scale = plan.scale;
  report.dimension = plan.dimension;
  report.measures = object::MeasuresText(sim::BodyOf(object, plan.scale, replay));
  report.planner = plan.planner;
  report.half_angle = check.half_angle.value_or(plan.half_angle);
  report.torsion = check.torsion.value_or(plan.torsion);
  report.finger_radius = check.finger_radius ? check.finger_radius : plan.finger_radius;
  if (plan.at_given_points && check.given_points != nullptr) {
    report.farthest_from_points = plan::FarthestFromPoints(checked.located, *check.given_points);
  }
  for (const plan::StepCheck& step : checked.steps) report.steps.emplace_back().check = step;
  const int passing = CountPassing(checked.steps);
  MeasureRegions(object, checked.located, passing, report);
  CheckCertificates(checked.located, passing, report);
  if (passing > 0) {
    sim::ReplayOptions options = replay;
    options.half_angle = report.half_angle;
    options.finger_radius = report.finger_radius;
    TakeReplay(replayer ? replayer(checked.located, report.half_angle, passing)
                        : sim::ReplayPlan(object, checked.located, options, observer, passing),
               report);
    ExamineSteps(object, checked.located, passing, report);
  }
  SkipAfterFailure(report.steps);
  return report;
}

void AddProofs(const plan::Plan& located, Report& report) {
  int entries = 0;
  for (const ReportStep& step : report.steps) {
    const plan::Reason reason = step.check.reason;
    const bool decided = reason == plan::Reason::kNone ||
                         reason == plan::Reason::kNotForceClosure ||
                         reason == plan::Reason::kNotProved;
    if (step.check.skipped || !decided) break;
    ++entries;
  }
  const std::vector<certificate::EntryProof> proofs =
      certificate::FindPlanProofs(located, report.half_angle, entries);
  for (std::size_t i = 0; i < proofs.size(); ++i) report.steps[i].proof = proofs[i];
}

plan::Plan MakeHoldPlan(const object::Object& object, const grasp::Grasp& grasp, double half_angle,
                        double scale) {
  plan::Plan plan;
  plan.scale = scale;
  plan.dimension = object.dimension();
  plan.half_angle = half_angle;
  plan.fingers = static_cast<int>(grasp.size());
  plan.initial = plan::FingersInOrder(grasp);
  plan.goal = grasp;
  if (!grasp.empty()) plan.torsion = grasp.front().torsion;
  return plan;
}

Report ValidateGrasp(const object::Object& object, const grasp::Grasp& grasp, double half_angle,
                     double scale, const sim::ReplayOptions& replay,
                     const sim::ReplayObserver& observer) {
  plan::Plan plan = MakeHoldPlan(object, grasp, half_angle, scale);
  plan.finger_radius = replay.finger_radius;
  Report report = Validate(object, plan, {}, replay, observer);
  const object::WrenchFrame frame = object.wrench_frame();
  report.grasp.emplace();
  report.grasp->fingers = grasp::MeasureFingerFriction(grasp, frame, half_angle);
  if (!report.grasp->fingers.empty()) {
    report.grasp->quality = grasp::BoundQuality(grasp, frame, half_angle);
  }
  return report;
}

}  // namespace regrasp::report
