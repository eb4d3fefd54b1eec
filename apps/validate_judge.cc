#include "apps/validate_judge.h"

#include <string>

#include "apps/program.h"
#include "apps/progress.h"
#include "planner/object/body_measures.h"
#include "planner/plan/grasp_io.h"
#include "report/report.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "sim/actuation/tip_geometry.h"
#include "sim/hand/check_hand.h"
#include "sim/scene/scaling.h"

namespace regrasp::apps {

namespace {

/// Between two rows of a finger in the trajectory: a switch takes some hundredths of a second.
constexpr double kSampleInterval_s = 5e-4;

sim::ReplayObserver MakeObserver(const ValidateOptions& options, ProgressLine& progress,
                                 Samples& samples) {
  sim::ReplayObserver observer;
  observer.on_progress = [&progress, &samples](int done, int total) {
    samples.entry_seconds.push_back(samples.entry.Lap());
    progress.Report("replay: " + std::to_string(done) + " of " + std::to_string(total) + " steps");
  };
  const bool trajectory = !options.trajectory.empty();
  const bool animate = options.animates();
  if (!trajectory && !animate) return observer;
  // How long a replay takes depends on the body: a moving picture is cut from all of its states.
  observer.sample_interval_s = animate ? 0 : kSampleInterval_s;
  observer.on_sample = [trajectory, animate, &samples](const plan::Snapshot& snapshot) {
    std::vector<plan::Snapshot>& rows = samples.trajectory;
    const bool due = rows.empty() || snapshot.time_s >= rows.back().time_s + kSampleInterval_s;
    if (trajectory && due) rows.push_back(snapshot);
    if (animate) samples.animation.push_back(snapshot);
  };
  return observer;
}

/// Replays by the hand of the task.
report::Replayer HandReplayer(const ValidateOptions& options, const ValidateTask& task,
                              const sim::ReplayObserver& observer, Samples& samples) {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*task.object->object);
  const sim::HandReplayOptions by_hand = HandOptions(options, task);
  static_cast<void>(sim::TipShapesOf(*task.hand, options.tip));  // before any work is done
  sim::HandReplayObserver watch;
  watch.on_progress = observer.on_progress;
  if (!options.trajectory.empty()) {
    watch.on_step = [&samples](const sim::HandWorld& world) { samples.by_hand.Add(world); };
  }
  if (!options.mjcf.empty()) {
    watch.on_rest = [&samples, &task](const sim::HandWorld& world, plan::EntryIndex entry) {
      const std::string kind = entry == 0 ? "hold" : plan::StepKind(plan::StepOf(task.plan, entry));
      samples.rests.push_back({std::to_string(entry) + " " + kind, world.time(),
                               world.Save().engine.qpos, world.controls()});
    };
  }
  return
      [by_hand, &task, &solid, watch](const plan::Plan& located, double half_angle, int entries) {
        sim::HandReplayOptions now = by_hand;
        now.half_angle = half_angle;
        return sim::ReplayHand(*task.hand, solid, located, now, watch, entries);
      };
}

report::Report Check(const ValidateOptions& options, const ValidateTask& task, Samples& samples) {
  const object::Object& object = *task.object->object;
  CheckTask given(options, task);
  ProgressLine progress(options.quiet);
  if (!options.hand.empty()) {
    progress.Report("checking the hand");
    given.CheckHand(options, task);
  }
  progress.Report(options.for_grasp() ? "checking the grasp" : "checking the plan");
  const sim::ReplayObserver observer = MakeObserver(options, progress, samples);
  if (!options.for_grasp()) {
    return report::Validate(object, task.plan, given.check, options.replay, observer,
                            options.replay_by_hand ? HandReplayer(options, task, observer, samples)
                                                   : report::Replayer());
  }
  return report::ValidateGrasp(object, task.grasp, task.plan.half_angle, task.plan.scale,
                               options.replay, observer);
}

/// The plan as the report judges it.
plan::Plan Located(const object::Object& object, const plan::Plan& plan,
                   const report::Report& report) {
  plan::Plan located = plan::LocatePlan(object, plan);
  plan::SetTorsion(report.torsion, located);
  return located;
}

/// Of a plan whose replay passes.
void AddTrials(const ValidateOptions& options, const ValidateTask& task, report::Report& report) {
  if (options.trials.count == 0) return;
  if (!report.passed()) return;
  ProgressLine progress(options.quiet);
  const auto tell = [&](int done) {
    progress.Report("trials: " + std::to_string(done) + " of " +
                    std::to_string(options.trials.count));
  };
  const object::Object& object = *task.object->object;
  if (options.replay_by_hand) {
    sim::HandReplayOptions replay = HandOptions(options, task);
    replay.half_angle = report.half_angle;
    replay.squeeze_N = report.settings->squeeze_N;
    report.trials =
        sim::RunHandTrials(*task.hand, dynamic_cast<const object::Polyhedron&>(object),
                           plan::LocatePlan(object, task.plan), replay, options.trials, tell);
    return;
  }
  sim::ReplayOptions replay = options.replay;
  replay.half_angle = report.half_angle;
  // The trials' verdict is MuJoCo's where both decide.
  if (replay.engine == sim::EngineChoice::kBoth) replay.engine = sim::EngineChoice::kMujoco;
  // A hand does not know of the noise.
  if (replay.hand_squeeze) replay.squeeze_N = report.settings->squeeze_N;
  report.trials = sim::RunTrials(object, Located(object, task.plan, report), replay, options.trials,
                                 report.settings->fingertip_radius_m, tell);
}

}  // namespace

CheckTask::CheckTask(const ValidateOptions& options, const ValidateTask& task) {
  const object::Object& object = *task.object->object;
  check.half_angle = options.friction.half_angle();
  check.torsion = options.contact.torsion();
  check.finger_radius = options.replay.finger_radius;
  check.allow_undecided = options.allow_undecided;
  if (task.plan.at_given_points) check.given_points = &task.given_points;
  if (!options.start.empty()) {
    start = plan::ParseGrasp(task.start_text, options.start, object);
    check.start = &start;
  }
  if (!options.goal.empty()) {
    goal = plan::ParseGrasp(task.goal_text, options.goal, object);
    check.goal = &goal;
  }
}

void CheckTask::CheckHand(const ValidateOptions& options, const ValidateTask& task) {
  const auto* solid = dynamic_cast<const object::Polyhedron*>(task.object->object.get());
  if (solid == nullptr || options.for_grasp()) {
    throw InputError("--hand: checks plans for solids that were made for a hand");
  }
  check.hand_faults = sim::CheckHand(*task.hand, *solid, plan::LocatePlan(*solid, task.plan),
                                     {options.clearance_m});
}

sim::HandReplayOptions HandOptions(const ValidateOptions& options, const ValidateTask& task) {
  sim::HandReplayOptions by_hand;
  by_hand.tolerance = options.tolerance;
  by_hand.feedback = options.feedback;
  by_hand.tip = options.tip;
  by_hand.mass_kg = sim::BodyOf(*task.object->object, task.plan.scale, options.replay).mass_kg;
  by_hand.shake = options.replay.shake;
  by_hand.squeeze_N = options.replay.squeeze_N;
  return by_hand;
}

report::Report JudgeTask(const ValidateOptions& options, const ValidateTask& task,
                         Samples& samples) {
  report::Report report = Check(options, task, samples);
  const object::ObjectFile& object = *task.object;
  report.measures += object::UnitText(object.unit);
  report.object_file = object.file;
  report.object_sha256 = object.sha256;
  AddTrials(options, task, report);
  if (options.certificates) {
    report::AddProofs(Located(*object.object, task.plan, report), report);
  }
  return report;
}

}  // namespace regrasp::apps
