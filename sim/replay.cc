#include "sim/replay.h"

#include <algorithm>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "sim/motions.h"
#include "sim/scene.h"
#include "sim/shake.h"
#include "sim/stage.h"

namespace regrasp {
namespace {

const Polyhedron& RequireSolid(const Object& object) {
  const auto* body = dynamic_cast<const Polyhedron*>(&object);
  if (body == nullptr) throw InputError("replay: planar objects cannot be replayed yet");
  return *body;
}

FingerGrasp ToScene(const Object& object, double scale, FingerGrasp grasp) {
  for (FingerContact& held : grasp) held.contact = ToScene(object, scale, held.contact);
  return grasp;
}

void RestoreRoles(Stage& stage) {
  for (StageFinger& finger : stage.fingers()) {
    finger.role = finger.holding ? FingerRole::kHolding : FingerRole::kFree;
    finger.previous_B = finger.contact.p;
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
  }
  (void)result;
}

StepReplay ReplayStep(Stage& stage, const Object& object, const Plan& plan, int index) {
  StepReplay result;
  result.index = index;
  RestoreRoles(stage);
  stage.StartJudging();
  try {
    stage.judge().SetPhase("motion");
    Perform(stage, object, plan, index, result);
    stage.judge().SetPhase("rest");
    Settle(stage);
    stage.JudgeRest();
    result.snapshot = stage.TakeSnapshot();
    Shake(stage);
    result.reason = stage.judge().reason();
    result.detail = stage.judge().detail();
  } catch (const UnstableError& error) {
    result.reason = Reason::kSimulationUnstable;
    result.detail = error.what();
  }
  result.displacement_m = stage.judge().displacement_m();
  result.rotation_deg = Degrees(stage.judge().rotation_rad());
  result.slip_m = stage.judge().slip_m();
  result.contact_lost = stage.judge().contact_lost();
  result.drift_m =
      MeasureMotion(Eigen::Isometry3d::Identity(), stage.X_SB(), stage.settings().diameter_m / 2);
  return result;
}

}  // namespace

ReplayResult ReplayPlan(const Object& object, const Plan& plan, const ReplayOptions& options,
                        const ReplayObserver& observer, int steps) {
  const Polyhedron& body = RequireSolid(object);
  const int all = static_cast<int>(plan.steps.size()) + 1;
  const int total = steps < 0 ? all : std::min(steps, all);
  ReplayResult result;
  if (total == 0) return result;
  Stage stage(body, plan, MakeScene(body, plan, total - 1, options), observer);
  result.settings = stage.settings();
  for (int index = 0; index < total; ++index) {
    result.steps.push_back(ReplayStep(stage, object, plan, index));
    if (observer.on_progress) observer.on_progress(index + 1, total);
    if (result.steps.back().reason != Reason::kNone) break;
  }
  return result;
}

std::string SceneMjcf(const Object& object, const Plan& plan, const ReplayOptions& options) {
  const Polyhedron& body = RequireSolid(object);
  const Scene scene = MakeScene(body, plan, static_cast<int>(plan.steps.size()), options);
  return FormatScene(scene, body, {}, /*surface=*/true);
}

}  // namespace regrasp
