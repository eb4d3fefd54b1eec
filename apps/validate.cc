// validate: checks a plan, or a single grasp, analytically, replays it in MuJoCo, draws a frame of
// each step, and says pass or fail.

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "apps/frame_files.h"
#include "apps/options.h"
#include "apps/page/report_page.h"
#include "apps/plan_object.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/verify_report.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/plan/plan_io.h"
#include "sim/report.h"
#include "sim/trajectory.h"

namespace {

using namespace regrasp;

constexpr char kProgram[] = "validate";

/// Between two rows of a finger in the trajectory: a switch takes some hundredths of a second.
constexpr double kSampleInterval_s = 5e-4;

/// Adds an option that takes a size in pixels, "1280x960".
CLI::Option* AddSize(CLI::App& app, const std::string& name, int& width, int& height,
                     const std::string& what) {
  const auto parse = [name, &width, &height](const std::string& text) {
    const std::size_t x = text.find('x');
    const auto side = [&](const std::string& digits) {
      const std::optional<double> value = ParseDouble(digits);
      const bool integer = digits.find_first_not_of("0123456789") == std::string::npos;
      if (!value || !integer || *value < kMinFrameSide || *value > kMaxFrameSide) {
        throw CLI::ValidationError(
            name, "expected WxH with sides from " + std::to_string(kMinFrameSide) + " to " +
                      std::to_string(kMaxFrameSide) + ", found \"" + text + "\"");
      }
      return static_cast<int>(*value);
    };
    width = side(text.substr(0, x));
    height = side(x == std::string::npos ? "" : text.substr(x + 1));
  };
  return app
      .add_option_function<std::string>(
          name, parse,
          what + ", pixels, each side from " + std::to_string(kMinFrameSide) + " to " +
              std::to_string(kMaxFrameSide) + " (default " + std::to_string(width) + "x" +
              std::to_string(height) + ")")
      ->type_name("WxH");
}

struct ValidateProgram {
  std::string object_path;
  std::string plan_path;
  std::string grasp_path;
  std::string out;
  std::string junit;
  std::string mjcf;
  std::string trajectory;
  std::string start;
  std::string goal;
  FrictionOptions friction;
  std::optional<double> scale;
  ReplayOptions replay;
  FrameOptions frame;
  AnimationOptions animation;
  bool no_frames = false;
  bool animate = false;
  bool show_clusters = false;
  bool certificates = false;
  std::string verify;
  bool allow_object_change = false;
  bool quiet = false;

  void AddTo(CLI::App& app);
  int Run();

 private:
  /// What a file on the command line asks for.
  struct Task {
    ObjectFile object;
    std::string file_text;  ///< of the plan or of the grasp
    Plan plan;              ///< of a grasp: without steps
    Grasp grasp;            ///< empty for a plan
  };
  /// States of the replay, as far as someone asked for them.
  struct Samples {
    std::vector<Snapshot> trajectory;
    std::vector<Snapshot> animation;
  };

  void AddFiles(CLI::App& app);
  void AddPictures(CLI::App& app);
  void AddPhysics(CLI::App& app);
  void CheckUsage() const;
  [[nodiscard]] const std::string& InputPath() const;
  [[nodiscard]] Task ReadTask() const;
  [[nodiscard]] ReplayObserver MakeObserver(ProgressLine& progress, Samples& samples) const;
  [[nodiscard]] ClusterView ClustersOf(const Task& task) const;
  [[nodiscard]] Report Check(const Task& task, Samples& samples) const;
  [[nodiscard]] int Verify(const Task& task) const;
  void WritePictures(const Task& task, const Samples& samples, const std::filesystem::path& folder,
                     Report& report) const;
  void WriteResults(const Task& task, const Samples& samples, Report& report) const;
  [[nodiscard]] std::filesystem::path Folder() const;
};

void ValidateProgram::AddTo(CLI::App& app) {
  AddFiles(app);
  AddPhysics(app);
  AddPictures(app);
  app.add_flag("--allow-object-change", allow_object_change,
               "Accept an object file with other bytes than the plan was made for");
  AddQuiet(app, quiet);
}

void ValidateProgram::AddPictures(CLI::App& app) {
  CLI::Option* none = app.add_flag("--no-frames", no_frames, "Draw no frames");
  app.add_flag("--show-focus", frame.show_focus,
               "Frames of a solid also show the focus point of four concurrent contacts, the lines "
               "to it, and the contact regions that it gives");
  app.add_flag("--show-clusters", show_clusters,
               "Frames of a plan over clustered contact points show the clusters on the surface, "
               "and their representatives as dots");
  AddSize(app, "--size", frame.width, frame.height, "Size of the frames");
  CLI::Option* moving =
      app.add_flag("--animate", animate,
                   "Also write the whole replay as a moving picture, replay.webp, slowed down")
          ->excludes(none);
  AddSize(app, "--animate-size", animation.width, animation.height, "Size of the moving picture")
      ->needs(moving);
}

void ValidateProgram::AddFiles(CLI::App& app) {
  const auto add = [&app](const std::string& name, std::string& value, const std::string& text) {
    return app.add_option(name, value, text)->type_name("FILE");
  };
  add("--object", object_path, "Object file")->required();
  CLI::Option* plan = add("--plan", plan_path, "Plan file; or --grasp");
  CLI::Option* grasp =
      add("--grasp", grasp_path,
          "Grasp file: asks for a single grasp, at the friction given here, whether it is force "
          "closure, the half-angle that it needs, its quality, and its weakest finger: the one "
          "whose own friction may fall least while all others keep theirs; holds and shakes it")
          ->excludes(plan);
  app.add_option("--out", out, "Folder for report and frames (default out/<plan or grasp name>)")
      ->type_name("DIR");
  add("--start", start, "Grasp file that the plan's initial grasp must be")->excludes(grasp);
  add("--goal", goal, "Grasp file that the plan's goal must be")->excludes(grasp);
  app.add_flag("--certificates", certificates,
               "The report also holds, for every grasp and all along every align, contact forces "
               "that prove force closure, or a twist that refutes it");
  add("--verify", verify,
      "Checks the proofs of a report that --certificates wrote, in exact rational arithmetic, "
      "against this plan and object; nothing is replayed or written")
      ->excludes(grasp);
  add("--junit", junit, "Write the verdicts as JUnit XML");
  add("--export-mjcf", mjcf, "Write the scene of the replay as MJCF for any MuJoCo");
  add("--trajectory", trajectory,
      "Write time (s), place (m) and force (N) of every finger during the replay as CSV");
}

void ValidateProgram::AddPhysics(CLI::App& app) {
  friction.AddTo(app);
  AddScale(app, scale)
      ->description(
          "Metres per unit of length of the object file; must be the plan's, 1 for a grasp where "
          "left out");
  CLI::Option* mass = AddNumber(app, "--mass", replay.mass_kg, NumberRange::Positive(),
                                "Mass of the object, kg; instead of --density")
                          ->type_name("KG");
  AddNumber(app, "--density", replay.density_kg_m3, NumberRange::Positive(),
            "Density of the object, kg/m^3 (default 1000)")
      ->type_name("KG_M3")
      ->excludes(mass);
  AddNumber(app, "--thickness", replay.thickness, NumberRange::Positive(),
            "Thickness of the prism that a planar object is, in the object file's own unit of "
            "length (default a quarter of the diameter)")
      ->type_name("X");
  AddNumber(app, "--squeeze", replay.squeeze_N, NumberRange::Positive(),
            "Sum of the normal forces of a grasp at rest, newtons (default: such "
            "that the weight is a tenth of the shake force, 1000 weights at the default shake)")
      ->type_name("N");
  AddNumber(app, "--shake", replay.shake, NumberRange::NotNegative(),
            "Size of the shake: force over squeeze, and torque over squeeze times half the "
            "diameter (default 0.01)")
      ->type_name("RHO");
  AddNumber(app, "--tolerance", replay.tolerance, NumberRange::Positive(),
            "How far the object may move and a fingertip slip, in diameters of the object "
            "(default 0.001)")
      ->type_name("X");
}

void ValidateProgram::CheckUsage() const {
  if (plan_path.empty() && grasp_path.empty()) throw InputError("--plan or --grasp is required");
  if (!grasp_path.empty() && allow_object_change) {
    throw InputError("--allow-object-change: a grasp file names no object");
  }
}

const std::string& ValidateProgram::InputPath() const {
  return grasp_path.empty() ? plan_path : grasp_path;
}

ValidateProgram::Task ValidateProgram::ReadTask() const {
  Task task;
  task.object = ReadObject(object_path);
  const Object& object = *task.object.object;
  task.file_text = ReadFile(InputPath());
  if (grasp_path.empty()) {
    task.plan = ParsePlan(task.file_text, plan_path);
    CheckPlanFits(task.plan, task.object, {plan_path, object_path, allow_object_change, scale});
  } else {
    task.grasp = ParseGrasp(task.file_text, grasp_path, object);
    task.plan = MakeHoldPlan(object, task.grasp, friction.required_half_angle(), scale.value_or(1));
  }
  if (replay.thickness && task.plan.dimension == 3) {
    throw InputError("--thickness: " + object_path + " is a solid, not a planar object");
  }
  return task;
}

ReplayObserver ValidateProgram::MakeObserver(ProgressLine& progress, Samples& samples) const {
  ReplayObserver observer;
  observer.on_progress = [&progress](int done, int total) {
    progress.Report("replay: " + std::to_string(done) + " of " + std::to_string(total) + " steps");
  };
  if (trajectory.empty() && !animate) return observer;
  // How long a replay takes depends on the body: a moving picture is cut from all of its states.
  observer.sample_interval_s = animate ? 0 : kSampleInterval_s;
  observer.on_sample = [this, &samples](const Snapshot& snapshot) {
    std::vector<Snapshot>& rows = samples.trajectory;
    const bool due = rows.empty() || snapshot.time_s >= rows.back().time_s + kSampleInterval_s;
    if (!trajectory.empty() && due) rows.push_back(snapshot);
    if (animate) samples.animation.push_back(snapshot);
  };
  return observer;
}

Report ValidateProgram::Check(const Task& task, Samples& samples) const {
  const Object& object = *task.object.object;
  CheckOptions check;
  check.half_angle = friction.half_angle();
  Grasp start_grasp;
  Grasp goal_grasp;
  if (!start.empty()) {
    start_grasp = ReadGrasp(start, object);
    check.start = &start_grasp;
  }
  if (!goal.empty()) {
    goal_grasp = ReadGrasp(goal, object);
    check.goal = &goal_grasp;
  }
  ProgressLine progress(quiet);
  progress.Report(grasp_path.empty() ? "checking the plan" : "checking the grasp");
  const ReplayObserver observer = MakeObserver(progress, samples);
  if (grasp_path.empty()) return Validate(object, task.plan, check, replay, observer);
  return ValidateGrasp(object, task.grasp, task.plan.half_angle, task.plan.scale, replay, observer);
}

ClusterView ValidateProgram::ClustersOf(const Task& task) const {
  const auto* solid = dynamic_cast<const Polyhedron*>(task.object.object.get());
  if (solid == nullptr || !task.plan.roadmap) {
    throw InputError("--show-clusters: " + InputPath() +
                     " was not made on a roadmap of clustered contact points");
  }
  return DescribeClusters(*solid, task.plan.half_angle, *task.plan.roadmap);
}

int ValidateProgram::Verify(const Task& task) const {
  const ReportVerification found =
      VerifyReport(verify, task.object, task.plan, Sha256(task.file_text));
  if (!quiet) std::cout << found.text;
  return found.proved ? kExitDone : kExitNegative;
}

std::filesystem::path ValidateProgram::Folder() const {
  if (!out.empty()) return out;
  return std::filesystem::path("out") / std::filesystem::path(InputPath()).stem();
}

void ValidateProgram::WritePictures(const Task& task, const Samples& samples,
                                    const std::filesystem::path& folder, Report& report) const {
  std::vector<PagePicture> pictures;
  if (!no_frames) {
    ProgressLine progress(quiet);
    progress.Report("drawing frames");
    pictures = WriteFrames(*task.object.object, task.plan, frame, folder, report);
  }
  if (animate) {
    ProgressLine progress(quiet);
    progress.Report("drawing the moving picture");
    WriteAnimation(*task.object.object, task.plan, samples.animation, animation, folder, report);
  }
  WriteFile(folder / "report.html", FormatReportHtml(report, task.plan, pictures));
}

void ValidateProgram::WriteResults(const Task& task, const Samples& samples, Report& report) const {
  const std::filesystem::path folder = Folder();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder.string() + ": " + error.message());
  RemoveFrames(folder);
  WritePictures(task, samples, folder, report);
  WriteFile(folder / "report.json", FormatReportJson(report));
  if (!junit.empty()) WriteFile(junit, FormatReportJunit(report));
  if (!trajectory.empty()) WriteFile(trajectory, FormatTrajectory(samples.trajectory));
}

int ValidateProgram::Run() {
  CheckUsage();
  const Task task = ReadTask();
  if (!verify.empty()) return Verify(task);
  if (show_clusters) frame.clusters = ClustersOf(task);
  const Object& object = *task.object.object;
  replay.half_angle = friction.half_angle();
  Samples samples;
  Report report = Check(task, samples);
  report.object_file = task.object.file;
  report.object_sha256 = task.object.sha256;
  report.plan_file = std::filesystem::path(InputPath()).filename().string();
  report.plan_sha256 = Sha256(task.file_text);
  if (certificates) AddProofs(LocatePlan(object, task.plan), report);
  WriteResults(task, samples, report);
  if (!mjcf.empty()) WriteFile(mjcf, SceneMjcf(object, LocatePlan(object, task.plan), replay));
  for (const std::string& warning : report.warnings()) {
    PrintMessage(kProgram, "warning: " + warning);
  }
  if (!quiet) std::cout << FormatReportTable(report);
  return report.passed() ? kExitDone : kExitNegative;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Checks a regrasp plan or a single grasp analytically, replays it in MuJoCo with frictional "
      "point fingers, "
      "shakes the object at every rest state, and says pass or fail.",
      kProgram);
  ValidateProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
