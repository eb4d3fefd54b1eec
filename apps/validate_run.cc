#include "apps/validate_run.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/batch/plan_library.h"
#include "apps/earlier_run.h"
#include "apps/frame_files.h"
#include "apps/locked_output_folder.h"
#include "apps/output_files.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/validate_task.h"
#include "apps/verify_report.h"
#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/body_measures.h"
#include "planner/plan/plan_io.h"
#include "render/viewer/viewer_scene.h"
#include "report/failure.h"
#include "report/markup.h"
#include "report/page/report_page.h"
#include "report/pictures/hand_recorder.h"
#include "report/pictures/replay_viewer.h"
#include "report/report.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/actuation/hand_world.h"
#include "sim/actuation/trajectory.h"
#include "sim/scene/scaling.h"
#include "sim/validation/validation.h"

namespace regrasp::apps {

namespace {

/// Time between two rows of a finger in the trajectory.
/// It is about a hundredth of a finger switch.
constexpr double kSampleInterval_s = 5e-4;

/// Data that is recorded during the replay, if the options require it.
struct ReplayRecord {
  Stopwatch run;   ///< time since the program began
  Stopwatch step;  ///< time since the last step was done
  std::vector<double> step_seconds;
  std::vector<plan::Snapshot> trajectory;  ///< trajectory of a replay by ideal fingers
  sim::HandTrajectory hand_trajectory;     ///< trajectory of a replay by a hand
  report::HandRecorder viewer;             ///< states of a replay by a hand for the 3-D replay
  std::vector<sim::SceneKey> rests;        ///< keyframes of a replay by a hand
};

/// Return the observer that records what the options need.
sim::ReplayObserver Recorder(const ValidateOptions& options, const plan::Plan& plan,
                             ReplayRecord& record) {
  sim::ReplayObserver observer;
  observer.on_progress = [&record](int, int) {
    record.step_seconds.push_back(record.step.Lap());
    record.viewer.EndEntry();
  };
  const bool trajectory = !options.trajectory.empty();
  observer.sample_interval_s = kSampleInterval_s;
  if (trajectory) {
    observer.on_sample = [&record](const plan::Snapshot& snapshot) {
      record.trajectory.push_back(snapshot);
    };
  }
  // Whether the plan passes is not known yet.
  const bool viewer =
      options.animates() || options.video_is_page() || options.has_viewer(/*passed=*/false);
  if (trajectory || viewer) {
    observer.on_time_step = [trajectory, viewer, &record](const sim::HandWorld& world) {
      if (trajectory) record.hand_trajectory.Add(world);
      if (viewer) record.viewer.Add(world);
    };
  }
  if (!options.mjcf.empty()) {
    observer.on_rest = [&record, &plan](const sim::HandWorld& world, plan::EntryIndex entry) {
      const std::string kind = entry == 0 ? "hold" : plan::StepKind(plan::StepOf(plan, entry));
      record.rests.push_back({std::to_string(entry) + " " + kind, world.time(),
                              world.Save().engine.qpos, world.controls()});
    };
  }
  return observer;
}

std::string UncheckedHandWarning(const ValidateOptions& options, const plan::Plan& plan) {
  if (!plan.hand || !options.hand.empty()) return "";
  return "joints and paths not checked: the plan is for the hand " + plan.hand->name +
         "; help: pass --hand " + plan.hand->file;
}

render::FrameOptions FrameOptionsFor(const ValidateOptions& options, const ValidateTask& task) {
  render::FrameOptions frame = options.frame;
  if (!options.show_clusters) return frame;
  const auto* solid = dynamic_cast<const object::Polyhedron*>(task.object->object.get());
  if (solid == nullptr || !task.plan.roadmap) {
    throw InputError("--show clusters: " + options.InputPath() +
                     " was not made on a roadmap of clustered contact points");
  }
  frame.clusters = roadmap::DescribeClusters(
      *solid, task.plan, task.plan.at_given_points ? &task.given_points : nullptr);
  return frame;
}

validation::ValidationResult ValidateAndRecord(const ValidateOptions& options,
                                               const ValidateTask& task, ReplayRecord& record) {
  ProgressLine progress(options.quiet);
  return ValidateFiles(options, task,
                       {.on_stage = [&progress](const std::string& text) { progress.Report(text); },
                        .replay = Recorder(options, task.plan, record)});
}

int Verify(const ValidateOptions& options, const ValidateTask& task) {
  const validation::ValidationSettings settings =
      validation::ResolveSettings(RequestOf(options, task));
  const ReportVerification found =
      VerifyReport(ReadFile(options.verify), options.verify,
                   {*task.object->object, task.object->sha256, settings.plan,
                    Sha256(task.file_text), settings.check});
  if (!options.quiet) std::cout << found.text;
  return found.proved ? kExitDone : kExitNegative;
}

std::vector<std::string> NamesOfResults(const ValidateOptions& options, const ValidateTask& task) {
  return ResultNames(task.plan, options.frames != Frames::kNone, options.animate);
}

/// Progress of drawing: always shown on a terminal, at intervals in a log.
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

/// Write the animations.
/// @returns animation for the HTML report: the video, or replay.webp.
report::PagePicture Animate(const ValidateOptions& options, render::FrameOptions frame,
                            const ValidateTask& task, const report::HandPicture* hand,
                            const ReplayRecord& record, const std::filesystem::path& folder,
                            report::Report& report) {
  frame.width = options.animation_width;
  frame.height = options.animation_height;
  frame.crop = false;
  std::vector<MovingFile> files;
  if (options.animate) files.push_back({folder / kAnimationName, render::AnimationFormat::kWebp});
  if (!options.video.empty() && !options.video_is_page()) {
    files.push_back({options.video, *render::FindAnimationFormat(options.video)});
  }
  DrawingCount count("drawing the animation", options.quiet);
  return WriteAnimation(
      *task.object->object, task.plan,
      {.frame = frame, .hand = hand, .workers = options.workers, .on_picture = count.reporter()},
      record.viewer.samples(), files, folder, report);
}

/// Return the names of the hand's fingers; none without a hand.
std::vector<std::string> FingerNames(const ValidateTask& task) {
  std::vector<std::string> names;
  if (!task.shared.hand) return names;
  for (const kinematics::Finger& finger : task.shared.hand->hand.fingers) {
    names.push_back(finger.name);
  }
  return names;
}

void WritePictures(const ValidateOptions& options, const render::FrameOptions& frame,
                   const ValidateTask& task, const ReplayRecord& record,
                   const std::filesystem::path& folder, report::Report& report) {
  const object::Object& object = *task.object->object;
  std::vector<report::PagePicture> pictures;
  std::optional<report::HandPicture> seen;
  const bool frames = options.draws_frames(report.passed());
  const bool viewer = options.video_is_page() || options.has_viewer(report.passed());
  if (task.shared.hand && (frames || viewer || options.animates())) {
    seen.emplace(*task.shared.hand, task.plan, task.plan.scale * object.mass_properties().centroid);
  }
  const report::HandPicture* hand = seen ? &*seen : nullptr;
  if (frames) {
    DrawingCount count("drawing frames", options.quiet);
    pictures = WriteFrames(object, task.plan,
                           {frame, hand, options.workers, options.sheet_width, count.reporter()},
                           folder, report);
  }
  report::PagePicture moving;
  if (options.animates()) moving = Animate(options, frame, task, hand, record, folder, report);
  std::string replay;
  if (viewer) {
    replay = render::FormatViewerScene(report::MakeViewerScene(
        object, task.plan, {.frame = frame, .hand = hand}, record.viewer.samples(), report));
  }
  if (options.video_is_page()) {
    WriteFile(options.video, report::FormatViewerHtml(report, task.plan, replay));
  }
  if (!options.has_viewer(report.passed())) replay.clear();
  report::IndexRow index;
  if (!options.index_key.empty()) {
    index = {"../" + std::string(kIndexName), options.index_key};
  }
  WriteFile(folder / kPageName, report::FormatReportHtml(report, task.plan, pictures, moving,
                                                         replay, FingerNames(task), index));
}

/// Check that no file of the run was removed.
/// The report that lists them is written next.
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

/// Return the digests of the files that were written.
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
                const report::Report& report, ReplayRecord& record) {
  if (options.junit.empty()) return;
  report::JunitSuite suite = report::MakeJunitSuite(report, PathForCi(folder));
  suite.seconds = record.run.Lap();
  report::SetCaseTimes(record.step_seconds, suite);
  WriteFile(options.junit, report::FormatJunit({suite}));
}

void WriteScene(const ValidateOptions& options, const ValidateTask& task,
                const ReplayRecord& record, const validation::ValidationSettings& settings) {
  const object::Object& object = *task.object->object;
  const plan::Plan& plan = settings.plan;
  if (!settings.hand) {
    WriteFile(options.mjcf, sim::SceneMjcf(object, plan, settings.replay));
    return;
  }
  sim::HandWorldOptions world;
  world.mu = std::tan(plan.friction_angle);
  world.tip = settings.hand->tip;
  world.mass_kg = sim::BodyOf(object, plan.scale, *settings.hand).mass_kg;
  WriteSceneFolder(
      options.mjcf,
      sim::ExportHandScene(*task.shared.hand, dynamic_cast<const object::Polyhedron&>(object),
                           plan.scale, world, record.rests));
}

std::string TrajectoryText(const ValidateOptions& options, const ReplayRecord& record) {
  if (!options.replay_by_hand) return sim::FormatTrajectory(record.trajectory);
  const sim::HandTrajectory& trajectory = record.hand_trajectory;
  return options.trajectory_is_npz() ? trajectory.FormatNpz() : trajectory.FormatCsv();
}

void WriteResults(const ValidateOptions& options, const render::FrameOptions& frame,
                  const ValidateTask& task, ReplayRecord& record, LockedOutputFolder& folder,
                  validation::ValidationResult& result) {
  report::Report& report = result.report;
  const std::vector<std::string> names = NamesOfResults(options, task);
  RemoveEarlierRun(folder, OwnResults(folder));
  folder.Announce(names);
  WritePictures(options, frame, task, record, folder.path(), report);
  WriteJunit(options, folder.path(), report, record);
  if (!options.trajectory.empty()) {
    WriteFile(options.trajectory, TrajectoryText(options, record));
  }
  if (!options.mjcf.empty()) WriteScene(options, task, record, result.settings);
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

/// Return "out/plan/report.html, report.json and 3 more".
std::string FilesText(const std::filesystem::path& folder, const report::Report& report) {
  // The HTML report is one of the listed files. The JSON report is not listed.
  const std::size_t others = report.run->files.size() - 1;
  return (folder / kPageName).string() + ", " + kReportName +
         (others > 0 ? " and " + std::to_string(others) + " more" : "");
}

/// Print warnings, and the table or the failure.
void Print(const ValidateOptions& options, const ValidateTask& task,
           const std::filesystem::path& folder, const report::Report& report) {
  const object::Object& object = *task.object->object;
  const object::BodyMeasures body = sim::BodyOf(object, task.plan.scale, options.replay);
  for (const std::string& warning :
       {object::SizeWarning(body, task.plan.scale), options.friction.warning(),
        plan::FilledContactsWarning(object, plan::ProjectPlan(object, task.plan)),
        UncheckedHandWarning(options, task.plan)}) {
    if (!warning.empty()) PrintMessage(kValidateName, "warning: " + warning);
  }
  for (const std::string& warning : HandWarnings(options, task)) {
    PrintMessage(kValidateName, "warning: " + warning);
  }
  for (const std::string& warning : report::Warnings(report)) {
    PrintMessage(kValidateName, "warning: " + warning);
  }
  if (!options.quiet && options.trials.count > 0 && !report.trials) {
    PrintMessage(kValidateName, "note: trials skipped, because the replay without noise fails");
  }
  if (!options.quiet && options.json != kStandardStream) {
    PrintTable(report::FormatReportTable(report), FilesText(folder, report));
  } else if (const auto failure = report::DescribeFailure(report)) {
    PrintError(kValidateName, failure->line());
  }
}

}  // namespace

void WriteSceneFolder(const std::string& folder, const std::vector<sim::SceneFile>& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder + ": cannot be created: " + error.message());
  for (const sim::SceneFile& file : files) {
    WriteFile(std::filesystem::path(folder) / file.name, file.bytes);
  }
}

ValidationRun RunValidation(const ValidateOptions& options) {
  ReplayRecord record;
  CheckOutputs(options);
  const std::string date = RunDate();
  const ValidateTask task = ReadTask(options);
  if (!options.verify.empty()) return {Verify(options, task), {}};
  const render::FrameOptions frame = FrameOptionsFor(options, task);
  LockedOutputFolder folder(options.Folder());
  ExpectFree(folder, OwnResults(folder), NamesOfResults(options, task));
  validation::ValidationResult result = ValidateAndRecord(options, task, record);
  report::Report& report = result.report;
  report.plan_file = std::filesystem::path(options.InputPath()).filename().string();
  report.plan_sha256 = Sha256(task.file_text);
  const RunInputs inputs = {{report.plan_file, report.plan_sha256},
                            {report.object_file, report.object_sha256},
                            options.start.empty() ? "" : Sha256(task.shared.start_text),
                            options.goal.empty() ? "" : Sha256(task.shared.goal_text),
                            task.shared.hand ? task.shared.hand->hand.sha256 : "",
                            RepairInput(options, task.file_text)};
  report.run = report::RunRecord{RunDigest(options, inputs),
                                 {},
                                 std::string(kValidateName) + " " + ProgramVersion(),
                                 CommandText(options, inputs),
                                 date};
  WriteResults(options, frame, task, record, folder, result);
  if (!options.silent) Print(options, task, folder.path(), report);
  return {report.passed() ? kExitDone : kExitNegative, record.step_seconds};
}

}  // namespace regrasp::apps
