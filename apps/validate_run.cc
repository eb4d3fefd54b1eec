#include "apps/validate_run.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/earlier_run.h"
#include "apps/frame_files.h"
#include "apps/held_folder.h"
#include "apps/output_files.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/run_date.h"
#include "apps/run_digest.h"
#include "apps/scene_folder.h"
#include "apps/validate_task.h"
#include "apps/verify_report.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/stopwatch.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/body_measures.h"
#include "planner/plan/invented_contacts.h"
#include "planner/plan/plan_io.h"
#include "report/failure.h"
#include "report/junit.h"
#include "report/page/report_page.h"
#include "report/report.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/actuation/hand_trajectory.h"
#include "sim/actuation/hand_trials.h"
#include "sim/actuation/tip_geometry.h"
#include "sim/hand/check_hand.h"
#include "sim/replay/trajectory.h"
#include "sim/scene/scaling.h"

namespace regrasp::apps {

namespace {

/// Between two rows of a finger in the trajectory: a switch takes some hundredths of a second.
constexpr double kSampleInterval_s = 5e-4;

/// What is kept of the replay while it runs; states as far as someone asked for them.
struct Samples {
  Stopwatch run;    ///< since the program began
  Stopwatch entry;  ///< since the last entry was done
  std::vector<double> entry_seconds;
  std::vector<plan::Snapshot> trajectory;
  sim::HandTrajectory by_hand;       ///< the same of a replay by a hand
  std::vector<sim::SceneKey> rests;  ///< the same
  std::vector<plan::Snapshot> animation;
};

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

/// What the analytic check is told besides the plan; it points to the grasps of the files.
struct CheckTask {
  CheckTask(const ValidateOptions& options, const ValidateTask& task) {
    const object::Object& object = *task.object.object;
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
  /// Of a plan for a hand.
  void CheckHand(const ValidateOptions& options, const ValidateTask& task) {
    const auto* solid = dynamic_cast<const object::Polyhedron*>(task.object.object.get());
    if (solid == nullptr || options.for_grasp()) {
      throw InputError("--hand: checks plans for solids that were made for a hand");
    }
    check.hand_faults = sim::CheckHand(*task.hand, *solid, plan::LocatePlan(*solid, task.plan),
                                       {options.clearance_m});
  }
  CheckTask(const CheckTask&) = delete;
  CheckTask& operator=(const CheckTask&) = delete;

  grasp::Grasp start;
  grasp::Grasp goal;
  plan::CheckOptions check;
};

sim::HandReplayOptions HandOptions(const ValidateOptions& options, const ValidateTask& task) {
  sim::HandReplayOptions by_hand;
  by_hand.tolerance = options.tolerance;
  by_hand.feedback = options.feedback;
  by_hand.tip = options.tip;
  by_hand.mass_kg = sim::BodyOf(*task.object.object, task.plan.scale, options.replay).mass_kg;
  by_hand.shake = options.replay.shake;
  by_hand.squeeze_N = options.replay.squeeze_N;
  return by_hand;
}

/// Replays by the hand of the task.
report::Replayer HandReplayer(const ValidateOptions& options, const ValidateTask& task,
                              const sim::ReplayObserver& observer, Samples& samples) {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*task.object.object);
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
  const object::Object& object = *task.object.object;
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

std::string UncheckedHandWarning(const ValidateOptions& options, const plan::Plan& plan) {
  if (!plan.hand || !options.hand.empty()) return "";
  return "the plan is for the hand " + plan.hand->name + "; --hand " + plan.hand->file +
         " checks its joints and paths, too";
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
  if (!report.passed()) {
    PrintMessage(kValidateName, "no trials: the replay without noise does not pass");
    return;
  }
  ProgressLine progress(options.quiet);
  const auto tell = [&](int done) {
    progress.Report("trials: " + std::to_string(done) + " of " +
                    std::to_string(options.trials.count));
  };
  const object::Object& object = *task.object.object;
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

render::FrameOptions FrameOptionsFor(const ValidateOptions& options, const ValidateTask& task) {
  render::FrameOptions frame = options.frame;
  if (!options.show_clusters) return frame;
  const auto* solid = dynamic_cast<const object::Polyhedron*>(task.object.object.get());
  if (solid == nullptr || !task.plan.roadmap) {
    throw InputError("--show-clusters: " + options.InputPath() +
                     " was not made on a roadmap of clustered contact points");
  }
  frame.clusters = roadmap::DescribeClusters(
      *solid, task.plan, task.plan.at_given_points ? &task.given_points : nullptr);
  return frame;
}

int Verify(const ValidateOptions& options, const ValidateTask& task) {
  const CheckTask given(options, task);
  const ReportVerification found = VerifyReport(
      ReadFile(options.verify), options.verify,
      {*task.object.object, task.object.sha256, task.plan, Sha256(task.file_text), given.check});
  if (!options.quiet) std::cout << found.text;
  return found.proved ? kExitDone : kExitNegative;
}

std::vector<std::string> NamesOfResults(const ValidateOptions& options, const ValidateTask& task) {
  return ResultNames(task.plan, !options.no_frames, options.animate);
}

/// Says how many pictures are drawn: on a terminal always, in a log now and then.
class DrawingCount {
 public:
  DrawingCount(std::string what, bool quiet)
      : what_(std::move(what)), line_(quiet), log_(kValidateName, quiet) {
    line_.Report(what_);
  }
  [[nodiscard]] std::function<void(int, int)> reporter() {
    return [this](int done, int all) {
      const std::string text =
          what_ + ": frame " + std::to_string(done) + " of " + std::to_string(all);
      line_.Report(text);
      log_.Report(text);
    };
  }

 private:
  std::string what_;
  ProgressLine line_;
  ProgressLog log_;
};

/// @returns what the page shows of it: replay.webp, or the video where only that is made.
report::PagePicture Animate(const ValidateOptions& options, render::FrameOptions frame,
                            const ValidateTask& task, const report::HandPicture* hand,
                            const Samples& samples, const std::filesystem::path& folder,
                            report::Report& report) {
  frame.width = options.animation_width;
  frame.height = options.animation_height;
  frame.crop = options.animation_crop;
  std::vector<MovingFile> files;
  if (options.animate) files.push_back({folder / kAnimationName, render::MovingFormat::kWebp});
  if (!options.video.empty()) {
    files.push_back({options.video, *render::MovingFormatOf(options.video)});
  }
  DrawingCount count("drawing the moving picture", options.quiet);
  return WriteAnimation(
      *task.object.object, task.plan,
      {.frame = frame, .hand = hand, .workers = options.workers, .on_picture = count.reporter()},
      samples.animation, files, report);
}

void WritePictures(const ValidateOptions& options, const render::FrameOptions& frame,
                   const ValidateTask& task, const Samples& samples,
                   const std::filesystem::path& folder, report::Report& report) {
  const object::Object& object = *task.object.object;
  std::vector<report::PagePicture> pictures;
  std::optional<report::HandPicture> seen;
  const bool draws = !options.no_frames || options.animates();
  if (task.hand && draws) {
    seen.emplace(*task.hand, task.plan, task.plan.scale * object.mass_properties().centroid);
  }
  const report::HandPicture* hand = seen ? &*seen : nullptr;
  if (!options.no_frames) {
    DrawingCount count("drawing frames", options.quiet);
    pictures = WriteFrames(object, task.plan,
                           {frame, hand, options.workers, options.sheet_width, count.reporter()},
                           folder, report);
  }
  report::PagePicture moving;
  if (options.animates()) moving = Animate(options, frame, task, hand, samples, folder, report);
  WriteFile(folder / kPageName, report::FormatReportHtml(report, task.plan, pictures, moving));
}

/// What is written last says that all of it is there.
void CheckPictures(const std::filesystem::path& folder, const report::Report& report) {
  std::vector<std::string> names = {kPageName};
  for (const report::ReportStep& step : report.steps) {
    if (!step.frame.empty()) names.push_back(step.frame);
  }
  for (const std::string& name : names) {
    std::error_code error;
    if (std::filesystem::exists(folder / name, error)) continue;
    throw EnvironmentError((folder / name).string() + ": was removed during the run");
  }
}

/// Those of the files that were written.
std::vector<report::FileDigest> DigestFiles(const std::filesystem::path& folder,
                                            const std::vector<std::string>& names) {
  std::vector<report::FileDigest> files;
  for (const std::string& name : names) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(folder / name, error)) continue;
    files.push_back({name, Sha256(ReadOutput(folder / name))});
  }
  return files;
}

void WriteJunit(const ValidateOptions& options, const std::filesystem::path& folder,
                const report::Report& report, Samples& samples) {
  if (options.junit.empty()) return;
  report::JunitSuite suite = report::MakeJunitSuite(report, PathForCi(folder));
  suite.seconds = samples.run.Lap();
  report::SetCaseTimes(samples.entry_seconds, suite);
  WriteFile(options.junit, report::FormatJunit({suite}));
}

void WriteScene(const ValidateOptions& options, const ValidateTask& task, const Samples& samples,
                const report::Report& report) {
  const object::Object& object = *task.object.object;
  if (!options.replay_by_hand) {
    sim::ReplayOptions replay = options.replay;
    replay.half_angle = options.friction.half_angle();
    WriteFile(options.mjcf, sim::SceneMjcf(object, plan::LocatePlan(object, task.plan), replay));
    return;
  }
  sim::HandWorldOptions world;
  world.mu = std::tan(report.half_angle);
  world.tip = options.tip;
  world.mass_kg = sim::BodyOf(object, task.plan.scale, options.replay).mass_kg;
  WriteSceneFolder(options.mjcf,
                   sim::ExportHandScene(*task.hand, dynamic_cast<const object::Polyhedron&>(object),
                                        task.plan.scale, world, samples.rests));
}

std::string TrajectoryText(const ValidateOptions& options, const Samples& samples) {
  if (!options.replay_by_hand) return sim::FormatTrajectory(samples.trajectory);
  return options.trajectory_is_npz() ? samples.by_hand.FormatNpz() : samples.by_hand.FormatCsv();
}

void WriteResults(const ValidateOptions& options, const render::FrameOptions& frame,
                  const ValidateTask& task, Samples& samples, HeldFolder& folder,
                  report::Report& report) {
  const std::vector<std::string> names = NamesOfResults(options, task);
  RemoveEarlierRun(folder, OwnResults(folder));
  folder.Announce(names);
  WritePictures(options, frame, task, samples, folder.path(), report);
  WriteJunit(options, folder.path(), report, samples);
  if (!options.trajectory.empty()) {
    WriteFile(options.trajectory, TrajectoryText(options, samples));
  }
  if (!options.mjcf.empty()) WriteScene(options, task, samples, report);
  CheckPictures(folder.path(), report);
  report.run->files = DigestFiles(folder.path(), names);
  const std::string text = report::FormatReportJson(report);
  WriteFile(folder.path() / kReportName, text);
  if (options.json == kStandardStream) {
    std::cout << text;
  } else if (!options.json.empty()) {
    WriteFile(options.json, text);
  }
}

/// "out/plan/report.html, report.json and 3 more".
std::string FilesText(const std::filesystem::path& folder, const report::Report& report) {
  // The page and the report; the report lists all but itself.
  const std::size_t others = report.run->files.size() - 1;
  return (folder / kPageName).string() + ", " + kReportName +
         (others > 0 ? " and " + std::to_string(others) + " more" : "");
}

}  // namespace

ValidationRun RunValidation(const ValidateOptions& options) {
  Samples samples;
  CheckOutputs(options);
  const std::string date = RunDate();
  const ValidateTask task = ReadTask(options);
  if (!options.verify.empty()) return {Verify(options, task), {}};
  const render::FrameOptions frame = FrameOptionsFor(options, task);
  HeldFolder folder(options.Folder());
  ExpectFree(folder, OwnResults(folder), NamesOfResults(options, task));
  const object::Object& object = *task.object.object;
  report::Report report = Check(options, task, samples);
  report.measures += object::UnitText(task.object.unit);
  report.object_file = task.object.file;
  report.object_sha256 = task.object.sha256;
  report.plan_file = std::filesystem::path(options.InputPath()).filename().string();
  report.plan_sha256 = Sha256(task.file_text);
  const RunInputs inputs = {{report.plan_file, report.plan_sha256},
                            {report.object_file, report.object_sha256},
                            options.start.empty() ? "" : Sha256(task.start_text),
                            options.goal.empty() ? "" : Sha256(task.goal_text),
                            options.hand.empty() ? "" : Sha256(ReadFile(options.hand))};
  report.run = report::RunRecord{RunDigest(options, inputs),
                                 {},
                                 std::string(kValidateName) + " " + ProgramVersion(),
                                 CommandText(options, inputs),
                                 date};
  AddTrials(options, task, report);
  if (options.certificates) report::AddProofs(Located(object, task.plan, report), report);
  WriteResults(options, frame, task, samples, folder, report);
  const object::BodyMeasures body = sim::BodyOf(object, task.plan.scale, options.replay);
  for (const std::string& warning :
       {object::SizeWarning(body, task.plan.scale), options.friction.warning(),
        plan::InventedContactsWarning(object, plan::LocatePlan(object, task.plan)),
        UncheckedHandWarning(options, task.plan)}) {
    if (!warning.empty()) PrintMessage(kValidateName, "warning: " + warning);
  }
  for (const std::string& warning : report.warnings()) {
    PrintMessage(kValidateName, "warning: " + warning);
  }
  if (!options.quiet && options.json != kStandardStream) {
    PrintTable(report::FormatReportTable(report), FilesText(folder.path(), report));
  } else if (const auto failure = report::DescribeFailure(report)) {
    PrintError(kValidateName, failure->headline() + "; why: " + failure->why +
                                  "; what would mend it: " + failure->mend);
  }
  return {report.passed() ? kExitDone : kExitNegative, samples.entry_seconds};
}

}  // namespace regrasp::apps
