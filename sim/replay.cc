#include "sim/replay.h"

#include <algorithm>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/grasp/grasp_forces.h"
#include "sim/align.h"
#include "sim/motions.h"
#include "sim/scene.h"
#include "sim/shake.h"
#include "sim/stage.h"
#include "sim/stillness.h"

namespace regrasp {
namespace {

void RestoreRoles(Stage& stage) {
  for (StageFinger& finger : stage.fingers()) {
    finger.role = finger.holding ? FingerRole::kHolding : FingerRole::kFree;
  }
}

/// What entry `index` of the report does between two rests.
void Perform(Stage& stage, const Object& object, const Plan& plan, int index, StepReplay& result) {
  if (index == 0) {
    TakeHold(stage, ToScene(object, plan.scale, plan.initial));
    return;
  }
  const Step& step = plan.steps[index - 1];
  if (const auto* change = std::get_if<Switch>(&step)) {
    SwitchFingers(stage, ToScene(object, plan.scale, change->place), change->release);
    return;
  }
  const auto& waypoints = std::get<Align>(step).waypoints;
  if (waypoints.empty()) return;
  const AlignScript& script = *stage.scene().scripts[index - 1];
  result.align_mode = PerformAlign(stage, script);
  result.align_shares = script.shares;
  std::vector<FingerGrasp> waypoints_B;
  for (const FingerGrasp& grasp : waypoints) {
    waypoints_B.push_back(ToScene(object, plan.scale, grasp));
  }
  TellMoved(stage, waypoints_B);
}

/// The step as the judge saw it.
StepMotion Describe(const Judge& judge) {
  StepMotion result;
  result.reason = judge.reason();
  result.detail = judge.detail();
  result.displacement_m = judge.displacement_m();
  result.rotation_deg = Degrees(judge.rotation_rad());
  result.moved_m = judge.moved_m();
  result.give_m = judge.give_m();
  result.slip_m = judge.slip_m();
  result.contact_lost = judge.contact_lost();
  return result;
}

StepMotion Unstable(const Judge& judge, const UnstableError& error) {
  StepMotion result = Describe(judge);
  // An object that is lost may well end in a state that the engine cannot bear.
  if (result.reason != Reason::kNone) return result;
  result.reason = Reason::kSimulationUnstable;
  result.detail = error.what();
  return result;
}

/// The step with its shakes; the judge is as before.
StepMotion ShakeAtRest(Stage& stage, Answer answer) {
  const Judge before = stage.judge();
  StepMotion result;
  stage.judge().ForgetForces();
  try {
    Shake(stage, answer);
    result = Describe(stage.judge());
  } catch (const UnstableError& error) {
    result = Unstable(stage.judge(), error);
  }
  result.shake_margins = stage.judge().margins();
  stage.judge() = before;
  return result;
}

FingerMargins MarginsNow(const Stage& stage) {
  FingerMargins margins;
  for (const int f : stage.HoldingFingers()) {
    const Eigen::Vector3d force = stage.engine().contact_force(f);
    const Eigen::Vector3d normal = stage.X_SB().linear() * stage.fingers()[f].contact.n;
    if (force.dot(normal) < kPressing * stage.settings().squeeze_N) continue;
    AddMargin(f, ConeMargin(force, normal, stage.half_angle()), margins);
  }
  return margins;
}

/// What is asked of a step once it is at rest.
void ExamineRest(Stage& stage, StepReplay& result) {
  const ReplaySettings& settings = stage.settings();
  result.rest_margins = MarginsNow(stage);
  result.snapshot = stage.TakeSnapshot();
  if (settings.protocol != Protocol::kFixed) {
    result.adapted = ShakeAtRest(stage, Answer::kAdapted);
  }
  if (settings.protocol != Protocol::kAdapted) result.fixed = ShakeAtRest(stage, Answer::kFixed);
  static_cast<StepMotion&>(result) = result.adapted ? *result.adapted : *result.fixed;
  // A grasp that lost the object before any push has no limit to look for.
  if (settings.stress && stage.judge().reason() == Reason::kNone)
    result.stress = MeasureStress(stage);
}

StepReplay ReplayStep(Stage& stage, const Object& object, const Plan& plan, int index) {
  StepReplay result;
  result.index = index;
  if (const std::string& why = stage.scene().unreachable[index]; !why.empty()) {
    result.reason = Reason::kUnreachable;
    result.detail = why;
    result.snapshot = stage.TakeSnapshot();
    return result;
  }
  RestoreRoles(stage);
  stage.StartJudging();
  try {
    stage.judge().SetPhase("motion");
    Perform(stage, object, plan, index, result);
    stage.judge().SetPhase("rest");
    ComeToRest(stage);
    result.motion_margins = stage.judge().margins();
    ExamineRest(stage, result);
  } catch (const UnstableError& error) {
    static_cast<StepMotion&>(result) = Unstable(stage.judge(), error);
  }
  result.drift_m =
      MeasureMotion(Eigen::Isometry3d::Identity(), stage.X_SB(), stage.settings().diameter_m / 2);
  return result;
}

/// The controls with which the fingers hold the initial grasp at rest, for the keyframe.
std::vector<Eigen::Vector3d> HoldControls(const Scene& scene, const Object& body,
                                          const Plan& plan) {
  const ReplaySettings& s = scene.settings;
  const Eigen::Vector3d up = s.gravity_m_s2 * Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Vector3d> push(scene.finger_start_S.size(), s.finger_mass_kg * up);
  const Grasp contacts = ContactsOf(ToScene(body, plan.scale, plan.initial));
  const GraspForces forces =
      ComputeGraspForces(contacts, {Eigen::Vector3d::Zero(), s.diameter_m / 2, scene.dimension},
                         std::atan(s.mu), {-s.mass_kg * up, Eigen::Vector3d::Zero()}, s.squeeze_N);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    push[plan.initial[i].finger] += forces.forces[i];
  }
  for (Eigen::Vector3d& control : push) control /= s.finger_stiffness_N_m;
  return push;
}

}  // namespace

ReplayResult ReplayPlan(const Object& object, const Plan& plan, const ReplayOptions& options,
                        const ReplayObserver& observer, int steps) {
  const int all = static_cast<int>(plan.steps.size()) + 1;
  const int total = steps < 0 ? all : std::min(steps, all);
  ReplayResult result;
  if (total == 0) return result;
  Stage stage(object, plan, MakeScene(object, plan, total - 1, options), observer);
  result.settings = stage.settings();
  CheckShake(result.settings);
  for (int index = 0; index < total; ++index) {
    result.steps.push_back(ReplayStep(stage, object, plan, index));
    if (observer.on_progress) observer.on_progress(index + 1, total);
    if (result.steps.back().reason != Reason::kNone) break;
  }
  return result;
}

std::string SceneMjcf(const Object& object, const Plan& plan, const ReplayOptions& options) {
  const Scene scene = MakeScene(object, plan, static_cast<int>(plan.steps.size()), options);
  return FormatScene(scene, object, HoldControls(scene, object, plan), /*surface=*/true);
}

}  // namespace regrasp
