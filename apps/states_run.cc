#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "apps/program.h"
#include "apps/progress.h"
#include "apps/validate_run.h"
#include "apps/validate_task.h"
#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/base/text_table.h"
#include "planner/gait/random_stances.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/reason.h"
#include "sim/actuation/reset_states.h"
#include "sim/scene/scaling.h"

namespace regrasp::apps {
namespace {

/// Maximum number of random grasps that are drawn to find a static grasp.
/// For objects that a hand can hold, at least one grasp in a thousand is a static grasp.
constexpr int kMostDraws = 50'000;
constexpr int kFewestFingers = 3;

/// Inputs of the reset states.
struct StatesTask {
  object::ObjectFile object;
  const object::Polyhedron* solid = nullptr;
  kinematics::HandFile hand;
  gait::GaitRequest request;
  sim::ResetStateOptions states;
  std::vector<std::string> doubts;  ///< warnings about size, friction and hand; can be empty
};

StatesTask ReadStatesTask(const ValidateOptions& options, ProgressLine& progress) {
  StatesTask task;
  task.object = ReadGraspObject(options, progress);
  task.solid = dynamic_cast<const object::Polyhedron*>(task.object.object.get());
  if (task.solid == nullptr) {
    throw InputError("--export-states requires a solid, found the planar object " +
                     options.object_path);
  }
  task.hand = kinematics::ReadHandFile(options.hand);
  if (std::ssize(task.hand.hand.fingers) < kFewestFingers) {
    throw InputError(options.hand +
                     ": --export-states requires a hand with at least 3 fingers, found " +
                     std::to_string(task.hand.hand.fingers.size()));
  }
  task.states.friction_angle = options.friction.required_friction_angle();
  task.request.scale = options.scale.value_or(1);
  task.request.margin = options.clearance_m;
  task.request.criteria = {task.states.friction_angle, options.min_quality};
  const object::BodyMeasures body =
      sim::BodyOf(*task.object.object, task.request.scale, options.replay);
  task.doubts = {object::SizeWarning(body, task.request.scale), options.friction.warning()};
  for (const std::string& warning : task.hand.warnings) {
    task.doubts.push_back(options.hand + ": " + warning);
  }
  task.states.mass_kg = body.mass_kg;
  task.states.grasp_force_N = options.replay.grasp_force_N;
  task.states.tolerance = options.tolerance;
  return task;
}

sim::DrawnStates Draw(const ValidateOptions& options, const StatesTask& task,
                      ProgressLine& progress) {
  gait::GaitRequest request = task.request;
  request.hand = &task.hand.hand;
  request.solid = task.solid;
  ProgressLog log(kValidateName, options.quiet);
  const auto told = [&](int done) {
    const std::string text =
        "states: " + std::to_string(done) + " of " + std::to_string(options.states);
    progress.Report(text);
    log.Report(text);
  };
  const auto make_draw = [&]() -> sim::DrawRest {
    const gait::RandomStanceOptions fingers{.fewest = kFewestFingers,
                                            .most = static_cast<int>(request.hand->fingers.size())};
    const auto rests = std::make_shared<gait::RandomStances>(request, fingers);
    return [rests](RandomStream& random) -> std::optional<sim::RestToHold> {
      auto rest = rests->Draw(random, kMostDraws);
      if (!rest) return std::nullopt;
      return sim::RestToHold{std::move(rest->state), std::move(rest->grasp)};
    };
  };
  return sim::DrawResetStates(
      task.hand, *task.solid, request.scale, task.states,
      {.count = options.states, .seed = options.trials.seed, .jobs = options.jobs, .told = told},
      make_draw);
}

std::string Percent(double share) { return FormatShort(100 * share, 3) + " %"; }

/// Return the table for the terminal.
std::string SummaryOf(const sim::DrawnStates& drawn) {
  std::vector<TextRow> rows = {{"random grasps", "number"},
                               {"stable, written", std::to_string(drawn.states.size())}};
  for (const auto& [reason, count] : drawn.fallen) {
    rows.push_back({"fallen: " + std::string(plan::ReasonName(reason)), std::to_string(count)});
  }
  if (drawn.unbalanced > 0) {
    rows.push_back({"cannot support the weight, not simulated", std::to_string(drawn.unbalanced)});
  }
  const ShareInterval interval = drawn.interval();
  return FormatRows(rows) + "fallen: " + Percent(drawn.fallen_share()) + " (" +
         Percent(interval.lower) + " to " + Percent(interval.upper) + " at " +
         Percent(sim::kTrialConfidence) + " confidence) of the simulated grasps\n";
}

void WriteStates(const ValidateOptions& options, const StatesTask& task,
                 const sim::DrawnStates& drawn) {
  std::error_code error;
  std::filesystem::create_directories(options.Folder(), error);
  if (error) throw EnvironmentError(options.Folder().string() + ": " + error.message());
  WriteFile(options.Folder() / kStatesName,
            sim::FormatResetStates(
                drawn, task.hand.hand, task.states,
                {task.object.file, task.object.sha256, task.request.scale, options.trials.seed}));
  if (options.mjcf.empty()) return;
  const sim::ResetState& first = drawn.states.front();
  WriteSceneFolder(options.mjcf,
                   sim::ExportHandScene(
                       task.hand, *task.solid, task.request.scale,
                       {std::tan(task.states.friction_angle), task.states.mass_kg, sim::kGravity},
                       {{"state 0", 0, first.qpos, first.controls}}));
}

}  // namespace

int RunStates(const ValidateOptions& options) {
  Stopwatch watch;
  CheckOutputs(options);
  ProgressLine progress(options.quiet);
  const StatesTask task = ReadStatesTask(options, progress);
  const sim::DrawnStates drawn = Draw(options, task, progress);
  progress.Clear();
  for (const std::string& doubt : task.doubts) {
    if (!doubt.empty()) PrintMessage(kValidateName, "warning: " + doubt);
  }
  if (!drawn.message.empty()) {
    PrintMessage(kValidateName,
                 "no states: " + options.object_path + ", " + options.hand + ": " + drawn.message);
    return kExitNegative;
  }
  WriteStates(options, task, drawn);
  if (!options.quiet) {
    std::cout << SummaryOf(drawn) << "files: " << (options.Folder() / kStatesName).string() << "\n"
              << "time: " << FormatShort(watch.Lap(), 3) << " s for " << drawn.states.size()
              << " states\n";
  }
  return kExitDone;
}

}  // namespace regrasp::apps
