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
#include "apps/validate_judge.h"
#include "apps/validate_task.h"
#include "apps/verify_report.h"
#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/body_measures.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/plan_io.h"
#include "report/failure.h"
#include "report/junit.h"
#include "report/page/report_page.h"
#include "report/report.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/actuation/hand_trajectory.h"
#include "sim/actuation/hand_world.h"
#include "sim/actuation/tip_geometry.h"
#include "sim/hand/check_hand.h"
#include "sim/replay/trajectory.h"
#include "sim/scene/scaling.h"

namespace regrasp::apps {

namespace {

std::string UncheckedHandWarning(const ValidateOptions& options, const plan::Plan& plan) {
  if (!plan.hand || !options.hand.empty()) return "";
  return "the plan is for the hand " + plan.hand->name + "; --hand " + plan.hand->file +
         " checks its joints and paths, too";
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

int Verify(const ValidateOptions& options, const ValidateTask& task) {
  const CheckTask given(options, task);
  const ReportVerification found = VerifyReport(
      ReadFile(options.verify), options.verify,
      {*task.object->object, task.object->sha256, task.plan, Sha256(task.file_text), given.check});
  if (!options.quiet) std::cout << found.text;
  return found.proved ? kExitDone : kExitNegative;
}

std::vector<std::string> NamesOfResults(const ValidateOptions& options, const ValidateTask& task) {
  return ResultNames(task.plan, options.frames != Frames::kNone, options.animate);
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
      *task.object->object, task.plan,
      {.frame = frame, .hand = hand, .workers = options.workers, .on_picture = count.reporter()},
      samples.animation, files, report);
}

void WritePictures(const ValidateOptions& options, const render::FrameOptions& frame,
                   const ValidateTask& task, const Samples& samples,
                   const std::filesystem::path& folder, report::Report& report) {
  const object::Object& object = *task.object->object;
  std::vector<report::PagePicture> pictures;
  std::optional<report::HandPicture> seen;
  const bool frames = options.draws_frames(report.passed());
  const bool draws = frames || options.animates();
  if (task.hand && draws) {
    seen.emplace(*task.hand, task.plan, task.plan.scale * object.mass_properties().centroid);
  }
  const report::HandPicture* hand = seen ? &*seen : nullptr;
  if (frames) {
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
  const object::Object& object = *task.object->object;
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

/// What the report says to people, and how the plan fails where it does.
void Print(const ValidateOptions& options, const ValidateTask& task,
           const std::filesystem::path& folder, const report::Report& report) {
  const object::Object& object = *task.object->object;
  const object::BodyMeasures body = sim::BodyOf(object, task.plan.scale, options.replay);
  for (const std::string& warning :
       {object::SizeWarning(body, task.plan.scale), options.friction.warning(),
        plan::InventedContactsWarning(object, plan::LocatePlan(object, task.plan)),
        UncheckedHandWarning(options, task.plan)}) {
    if (!warning.empty()) PrintMessage(kValidateName, "warning: " + warning);
  }
  for (const std::string& warning : HandWarnings(options, task)) {
    PrintMessage(kValidateName, "warning: " + warning);
  }
  for (const std::string& warning : report.warnings()) {
    PrintMessage(kValidateName, "warning: " + warning);
  }
  if (!options.quiet && options.trials.count > 0 && !report.trials) {
    PrintMessage(kValidateName, "no trials: the replay without noise does not pass");
  }
  if (!options.quiet && options.json != kStandardStream) {
    PrintTable(report::FormatReportTable(report), FilesText(folder, report));
  } else if (const auto failure = report::DescribeFailure(report)) {
    PrintError(kValidateName, failure->line());
  }
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
  report::Report report = JudgeTask(options, task, samples);
  report.plan_file = std::filesystem::path(options.InputPath()).filename().string();
  report.plan_sha256 = Sha256(task.file_text);
  const RunInputs inputs = {{report.plan_file, report.plan_sha256},
                            {report.object_file, report.object_sha256},
                            options.start.empty() ? "" : Sha256(task.start_text),
                            options.goal.empty() ? "" : Sha256(task.goal_text),
                            task.hand ? task.hand->hand.sha256 : "",
                            RepairInput(options, task.file_text)};
  report.run = report::RunRecord{RunDigest(options, inputs),
                                 {},
                                 std::string(kValidateName) + " " + ProgramVersion(),
                                 CommandText(options, inputs),
                                 date};
  WriteResults(options, frame, task, samples, folder, report);
  if (!options.silent) Print(options, task, folder.path(), report);
  return {report.passed() ? kExitDone : kExitNegative, samples.entry_seconds};
}

}  // namespace regrasp::apps
