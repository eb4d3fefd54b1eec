// validate: checks a plan analytically, replays it in MuJoCo, draws a frame of each step, and says
// pass or fail.

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "apps/frame_files.h"
#include "apps/options.h"
#include "apps/plan_object.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "page/report_page.h"
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

struct ValidateProgram {
  std::string object_path;
  std::string plan_path;
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
  bool no_frames = false;
  bool show_clusters = false;
  bool allow_object_change = false;
  bool quiet = false;

  void AddTo(CLI::App& app);
  int Run();

 private:
  void AddFiles(CLI::App& app);
  void AddPhysics(CLI::App& app);
  void SetSize(const std::string& text);
  void CheckPlanFits(const Plan& plan, const ObjectFile& object) const;
  ClusterView ClustersOf(const Plan& plan, const ObjectFile& object) const;
  Report Check(const Plan& plan, const ObjectFile& object, std::vector<Snapshot>& samples) const;
  void WriteResults(const Plan& plan, const ObjectFile& object,
                    const std::vector<Snapshot>& samples, Report& report) const;
  [[nodiscard]] std::filesystem::path Folder() const;
};

void ValidateProgram::AddTo(CLI::App& app) {
  AddFiles(app);
  AddPhysics(app);
  app.add_flag("--no-frames", no_frames, "Draw no frames");
  app.add_flag("--show-focus", frame.show_focus,
               "Frames of a solid also show the focus point of four concurrent contacts, the lines "
               "to it, and the contact regions that it gives");
  app.add_flag("--show-clusters", show_clusters,
               "Frames of a plan over clustered contact points show the clusters on the surface, "
               "and their representatives as dots");
  app.add_option_function<std::string>(
         "--size", [this](const std::string& text) { SetSize(text); },
         "Size of the frames, pixels, each side from " + std::to_string(kMinFrameSide) + " to " +
             std::to_string(kMaxFrameSide) + " (default 1280x960)")
      ->type_name("WxH");
  app.add_flag("--allow-object-change", allow_object_change,
               "Accept an object file with other bytes than the plan was made for");
  AddQuiet(app, quiet);
}

void ValidateProgram::AddFiles(CLI::App& app) {
  const auto add = [&app](const std::string& name, std::string& value, const std::string& text) {
    return app.add_option(name, value, text)->type_name("FILE");
  };
  add("--object", object_path, "Object file")->required();
  add("--plan", plan_path, "Plan file")->required();
  app.add_option("--out", out, "Folder for report and frames (default out/<plan name>)")
      ->type_name("DIR");
  add("--start", start, "Grasp file that the plan's initial grasp must be");
  add("--goal", goal, "Grasp file that the plan's goal must be");
  add("--junit", junit, "Write the verdicts as JUnit XML");
  add("--export-mjcf", mjcf, "Write the scene of the replay as MJCF for any MuJoCo");
  add("--trajectory", trajectory,
      "Write time (s), place (m) and force (N) of every finger during the replay as CSV");
}

void ValidateProgram::AddPhysics(CLI::App& app) {
  friction.AddTo(app);
  AddScale(app, scale)
      ->description("Metres per unit of length of the object file; must be the plan's");
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

void ValidateProgram::SetSize(const std::string& text) {
  const std::size_t x = text.find('x');
  const auto side = [&](const std::string& digits) {
    const std::optional<double> value = ParseDouble(digits);
    const bool integer = digits.find_first_not_of("0123456789") == std::string::npos;
    if (!value || !integer || *value < kMinFrameSide || *value > kMaxFrameSide) {
      throw CLI::ValidationError(
          "--size", "expected WxH with sides from " + std::to_string(kMinFrameSide) + " to " +
                        std::to_string(kMaxFrameSide) + ", found \"" + text + "\"");
    }
    return static_cast<int>(*value);
  };
  frame.width = side(text.substr(0, x));
  frame.height = side(x == std::string::npos ? "" : text.substr(x + 1));
}

void ValidateProgram::CheckPlanFits(const Plan& plan, const ObjectFile& object) const {
  regrasp::CheckPlanFits(plan, object, {plan_path, object_path, allow_object_change, scale});
  if (replay.thickness && plan.dimension == 3) {
    throw InputError("--thickness: " + object_path + " is a solid, not a planar object");
  }
}

ClusterView ValidateProgram::ClustersOf(const Plan& plan, const ObjectFile& object) const {
  const auto* solid = dynamic_cast<const Polyhedron*>(object.object.get());
  if (solid == nullptr || !plan.roadmap || plan.roadmap->clusters == 0) {
    throw InputError("--show-clusters: " + plan_path +
                     " was not made on a roadmap of clustered contact points");
  }
  return DescribeClusters(*solid, plan.half_angle, *plan.roadmap);
}

Report ValidateProgram::Check(const Plan& plan, const ObjectFile& object,
                              std::vector<Snapshot>& samples) const {
  CheckOptions check;
  check.half_angle = friction.half_angle();
  Grasp start_grasp;
  Grasp goal_grasp;
  if (!start.empty()) {
    start_grasp = ReadGrasp(start, *object.object);
    check.start = &start_grasp;
  }
  if (!goal.empty()) {
    goal_grasp = ReadGrasp(goal, *object.object);
    check.goal = &goal_grasp;
  }
  ProgressLine progress(quiet);
  progress.Report("checking the plan");
  ReplayObserver observer;
  observer.on_progress = [&](int done, int total) {
    progress.Report("replay: " + std::to_string(done) + " of " + std::to_string(total) + " steps");
  };
  if (!trajectory.empty()) {
    observer.sample_interval_s = kSampleInterval_s;
    observer.on_sample = [&](const Snapshot& snapshot) { samples.push_back(snapshot); };
  }
  return Validate(*object.object, plan, check, replay, observer);
}

std::filesystem::path ValidateProgram::Folder() const {
  if (!out.empty()) return out;
  return std::filesystem::path("out") / std::filesystem::path(plan_path).stem();
}

void ValidateProgram::WriteResults(const Plan& plan, const ObjectFile& object,
                                   const std::vector<Snapshot>& samples, Report& report) const {
  const std::filesystem::path folder = Folder();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder.string() + ": " + error.message());
  RemoveFrames(folder);
  std::vector<PagePicture> pictures;
  if (!no_frames) {
    ProgressLine progress(quiet);
    progress.Report("drawing frames");
    pictures = WriteFrames(*object.object, plan, frame, folder, report);
  }
  WriteFile(folder / "report.html", FormatReportHtml(report, plan, pictures));
  WriteFile(folder / "report.json", FormatReportJson(report));
  if (!junit.empty()) WriteFile(junit, FormatReportJunit(report));
  if (!trajectory.empty()) WriteFile(trajectory, FormatTrajectory(samples));
}

int ValidateProgram::Run() {
  const ObjectFile object = ReadObject(object_path);
  const std::string plan_text = ReadFile(plan_path);
  const Plan plan = ParsePlan(plan_text, plan_path);
  CheckPlanFits(plan, object);
  if (show_clusters) frame.clusters = ClustersOf(plan, object);
  replay.half_angle = friction.half_angle();
  std::vector<Snapshot> samples;
  Report report = Check(plan, object, samples);
  report.object_file = object.file;
  report.object_sha256 = object.sha256;
  report.plan_file = std::filesystem::path(plan_path).filename().string();
  report.plan_sha256 = Sha256(plan_text);
  WriteResults(plan, object, samples, report);
  if (!mjcf.empty())
    WriteFile(mjcf, SceneMjcf(*object.object, LocatePlan(*object.object, plan), replay));
  for (const std::string& warning : report.warnings()) {
    PrintMessage(kProgram, "warning: " + warning);
  }
  if (!quiet) std::cout << FormatReportTable(report);
  return report.passed() ? kExitDone : kExitNegative;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Checks a regrasp plan analytically, replays it in MuJoCo with frictional point fingers, "
      "shakes the object at every rest state, and says pass or fail.",
      kProgram);
  ValidateProgram program;
  program.AddTo(app);
  return RunProgram(app, argc, argv, [&] { return program.Run(); });
}
