#include "sim/validation/validation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "planner/base/error.h"
#include "planner/certificate/align_certificate.h"
#include "planner/certificate/plan_proof.h"
#include "planner/grasp/quality.h"
#include "planner/object/body_measures.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "sim/actuation/tip_geometry.h"
#include "sim/measure/disturbance.h"
#include "sim/scene/scaling.h"

namespace regrasp::validation {
namespace {

void ReportStage(const ValidationObserver& observer, const std::string& text) {
  if (observer.on_stage) observer.on_stage(text);
}

const object::Polyhedron& SolidOf(const ValidationRequest& request) {
  const auto* solid = dynamic_cast<const object::Polyhedron*>(&request.object);
  if (solid == nullptr || request.is_grasp) {
    throw InputError("validation with a hand: requires a solid and a plan");
  }
  return *solid;
}

void CheckHand(const ValidationRequest& request, ValidationSettings& settings) {
  const object::Polyhedron& solid = SolidOf(request);
  settings.check.hand_faults = sim::CheckHand(
      *request.hand, solid, plan::ProjectPlan(solid, settings.plan), request.options.hand_check);
  // Refuse unsuitable fingertips before the long part of the work.
  if (settings.hand) static_cast<void>(sim::TipShapesOf(*request.hand, settings.hand->tip));
}

/// Return how many steps pass the analytic check, from the first on.
int CountPassing(const std::vector<ReportStep>& steps) {
  const auto fails = [](const ReportStep& step) {
    return step.check.skipped || step.check.reason != plan::Reason::kNone;
  };
  return static_cast<int>(std::find_if(steps.begin(), steps.end(), fails) - steps.begin());
}

/// Check the plan, and locate it.
void CheckPlan(const ValidationRequest& request, ValidationResult& result) {
  ValidationSettings& settings = result.settings;
  plan::PlanCheck checked = plan::CheckPlan(request.object, settings.plan, settings.check);
  settings.plan = std::move(checked.projected);
  const plan::Plan& plan = settings.plan;
  Report& report = result.report;
  report.scale = plan.scale;
  report.dimension = plan.dimension;
  report.measures = object::MeasuresText(sim::BodyOf(request.object, plan.scale, settings.replay));
  report.planner = plan.planner;
  report.friction_angle = plan.friction_angle;
  report.torsion = plan.torsion;
  report.finger_radius = plan.finger_radius;
  if (plan.at_given_points && request.given_points != nullptr) {
    report.farthest_from_points = plan::FarthestFromPoints(plan, *request.given_points);
  }
  for (const plan::StepCheck& step : checked.steps) report.steps.emplace_back().check = step;
}

/// Measure contact regions of switches that pass the check.
void MeasureRegions(const object::Object& object, const plan::Plan& projected, int count,
                    Report& report) {
  const auto* polygon = dynamic_cast<const object::Polygon*>(&object);
  if (polygon == nullptr) return;
  plan::FingerGrasp before = projected.initial;
  for (plan::EntryIndex index{1}; index < count; ++index) {
    const plan::Step& step = plan::StepOf(projected, index);
    if (const auto* change = std::get_if<plan::Switch>(&step)) {
      report.steps[index].region =
          plan::MeasureSwitchRegion(*polygon, before, *change, report.friction_angle);
    }
    before = plan::GraspAfter(before, step);
  }
}

/// Check the certificates of sliding steps that pass the check.
void CheckCertificates(const plan::Plan& projected, int count, Report& report) {
  for (plan::EntryIndex index{1}; index < count; ++index) {
    const auto* align = std::get_if<plan::Align>(&plan::StepOf(projected, index));
    if (align == nullptr || !align->certificate) continue;
    report.steps[index].certificate = certificate::CheckAlignCertificate(
        *align, report.dimension, std::tan(report.friction_angle), *align->certificate);
  }
}

void Replay(const ValidationRequest& request, const ValidationObserver& observer, int count,
            ValidationResult& result) {
  const ValidationSettings& settings = result.settings;
  sim::ReplayObserver watch = observer.replay;
  watch.on_progress = [&observer](int done, int total) {
    if (observer.replay.on_progress) observer.replay.on_progress(done, total);
    ReportStage(observer,
                "replay: " + std::to_string(done) + " of " + std::to_string(total) + " steps");
  };
  sim::ReplayResult replayed =
      settings.hand ? sim::ReplayHand(*request.hand, SolidOf(request), settings.plan,
                                      *settings.hand, watch, count)
                    : sim::ReplayPlan(request.object, settings.plan, settings.replay, watch, count);
  result.report.settings = std::move(replayed.settings);
  for (sim::StepReplay& step : replayed.steps) {
    result.report.steps[step.index].replay = std::move(step);
  }
}

/// Find the weakest finger of the steps that pass the check, and why results disagree.
void ExamineSteps(const object::Object& object, const plan::Plan& projected, int count,
                  Report& report) {
  sim::WeakestFingers fingers(projected, object.wrench_frame(), report.friction_angle);
  for (plan::EntryIndex index{0}; index < count; ++index) {
    ReportStep& step = report.steps[index];
    step.weakest_finger = fingers.OfEntry(index);
    if (!step.replay) continue;
    const sim::ExaminedStep examined{object, projected, step.check, *step.replay, *report.settings};
    step.engines = sim::ExplainEngines(examined);
    // Likely causes of a failed replay are known only for point fingers.
    if (!report.settings->hand) step.disagreement = sim::ExplainDisagreement(examined);
  }
}

/// Skip the steps after the first failure of the check or the replay.
void SkipAfterFailure(std::vector<ReportStep>& steps) {
  bool failed = false;
  for (ReportStep& step : steps) {
    step.skipped = failed || step.check.skipped;
    failed = failed || step.reason() != plan::Reason::kNone;
    // A step passes only if it was replayed.
    if (!failed && !step.replay) throw std::logic_error("the replay omits a step");
  }
}

void MeasureGrasp(const object::Object& object, const plan::Plan& projected, Report& report) {
  const grasp::Grasp grasp = plan::ContactsOf(projected.initial);
  const object::WrenchFrame frame = object.wrench_frame();
  report.grasp.emplace();
  report.grasp->fingers = grasp::MeasureFingerFriction(grasp, frame, report.friction_angle);
  if (report.grasp->fingers.empty()) return;
  report.grasp->quality = grasp::BoundQuality(grasp, frame, report.friction_angle);
}

/// Run trials with the grasp force of the replay without noise.
void RunTrials(const ValidationRequest& request, const ValidationObserver& observer,
               ValidationResult& result) {
  const sim::TrialOptions& trials = request.options.trials;
  const auto progress = [&](int done) {
    ReportStage(observer,
                "trials: " + std::to_string(done) + " of " + std::to_string(trials.count));
  };
  const ValidationSettings& settings = result.settings;
  Report& report = result.report;
  if (settings.hand) {
    report.trials = sim::RunHandTrials(*request.hand, SolidOf(request), settings.plan,
                                       *settings.hand, trials, progress);
    return;
  }
  sim::ReplayOptions options = settings.replay;
  // With two engines MuJoCo decides.
  if (options.engine == sim::EngineChoice::kBoth) options.engine = sim::EngineChoice::kMujoco;
  // A hand does not know the noise.
  if (options.hand_grasp_force) options.grasp_force_N = report.settings->grasp_force_N;
  report.trials = sim::RunTrials(request.object, settings.plan, options, trials,
                                 report.settings->fingertip_radius_m, progress);
}

/// Replay the plan by the hand under each condition.
void ReplayUnderConditions(const ValidationRequest& request, const ValidationObserver& observer,
                           ValidationResult& result) {
  const ValidationOptions& options = request.options;
  const auto progress = [&](int done) {
    ReportStage(observer, "conditions: " + std::to_string(done) + " of " +
                              std::to_string(options.conditions.size()));
  };
  const ValidationSettings& settings = result.settings;
  result.report.conditions =
      sim::RunConditions(*request.hand, SolidOf(request), settings.plan, *settings.hand,
                         options.conditions, options.condition_jobs, progress);
  result.report.conditions->required = options.required_conditions;
}

/// Prove force closure or its loss in each step up to the first with another fault.
void AddProofs(const plan::Plan& projected, Report& report) {
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
      certificate::FindPlanProofs(projected, report.friction_angle, entries);
  for (std::size_t i = 0; i < proofs.size(); ++i) report.steps[i].proof = proofs[i];
}

}  // namespace

ValidationSettings ResolveSettings(const ValidationRequest& request) {
  const ValidationOptions& options = request.options;
  ValidationSettings settings{.plan = request.plan, .check = {}, .replay = options.replay};
  plan::Plan& plan = settings.plan;
  plan.friction_angle = options.friction_angle.value_or(plan.friction_angle);
  plan::SetTorsion(options.torsion.value_or(plan.torsion), plan);
  if (options.replay.finger_radius) plan.finger_radius = options.replay.finger_radius;
  sim::UseMassOf(plan, settings.replay);
  settings.check.start = request.start;
  settings.check.goal = request.goal;
  settings.check.given_points = request.given_points;
  settings.check.allow_undecided = options.allow_undecided;
  if (request.hand != nullptr && options.replay_by_hand) {
    settings.hand = options.hand;
    static_cast<sim::ReplayConditions&>(*settings.hand) = settings.replay;
    settings.hand->engine = options.replay.engine;
  } else if (plan::HasRolling(plan)) {
    throw InputError(request.plan_name +
                     ": fingertips roll in its in-hand motions, which only a hand executes; "
                     "help: pass --hand " +
                     plan.hand->file +
                     (request.hand == nullptr ? "" : ", without --replay points"));
  }
  return settings;
}

ValidationResult Validate(const ValidationRequest& given, const ValidationObserver& observer) {
  ValidationRequest request = given;
  std::optional<kinematics::HandFile> hand;
  if (given.hand != nullptr) request.hand = &hand.emplace(HandOfPlan(*given.hand, given.plan));
  ValidationResult result{ResolveSettings(request), {}};
  if (request.hand != nullptr) {
    ReportStage(observer, "checking the hand");
    CheckHand(request, result.settings);
  }
  ReportStage(observer, request.is_grasp ? "checking the grasp" : "checking the plan");
  CheckPlan(request, result);
  const plan::Plan& plan = result.settings.plan;
  Report& report = result.report;
  const int passing = CountPassing(report.steps);
  MeasureRegions(request.object, plan, passing, report);
  CheckCertificates(plan, passing, report);
  if (passing > 0) {
    Replay(request, observer, passing, result);
    ExamineSteps(request.object, plan, passing, report);
  }
  SkipAfterFailure(report.steps);
  if (request.hand != nullptr) report.goals = EvaluateGoals(plan, report);
  if (request.is_grasp) MeasureGrasp(request.object, plan, report);
  if (request.options.trials.count > 0 && report.passed()) RunTrials(request, observer, result);
  if (!request.options.conditions.empty() && result.settings.hand &&
      passing == std::ssize(report.steps)) {
    ReplayUnderConditions(request, observer, result);
  }
  if (request.options.certificates) AddProofs(plan, report);
  return result;
}

plan::Plan MakeHoldPlan(const object::Object& object, const grasp::Grasp& grasp,
                        double friction_angle, double scale) {
  plan::Plan plan;
  plan.scale = scale;
  plan.dimension = object.dimension();
  plan.friction_angle = friction_angle;
  plan.fingers = static_cast<int>(grasp.size());
  plan.initial = plan::FingersInOrder(grasp);
  plan.goal = grasp;
  if (!grasp.empty()) plan.torsion = grasp.front().torsion;
  return plan;
}

}  // namespace regrasp::validation
