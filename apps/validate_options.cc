#include "apps/validate_options.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <set>
#include <system_error>
#include <thread>

#include "apps/help.h"
#include "apps/list_option.h"
#include "apps/validate_modes.h"
#include "apps/validate_simulation.h"
#include "apps/view_options.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "render/picture/animation.h"

namespace regrasp::apps {

namespace {

/// Return a parser of a size in pixels, "1280x960".
ListOption::Parser SizeParser(int& width, int& height) {
  return [&width, &height](const std::string& name, const std::string& text) {
    const std::size_t x = text.find('x');
    const auto side = [&](const std::string& digits) {
      const std::optional<double> value = ParseDouble(digits);
      const bool integer = digits.find_first_not_of("0123456789") == std::string::npos;
      if (!value || !integer || *value < render::kMinFrameSide || *value > render::kMaxFrameSide) {
        throw CLI::ValidationError(
            name, "expected WxH with sides from " + std::to_string(render::kMinFrameSide) + " to " +
                      std::to_string(render::kMaxFrameSide) + ", found \"" + text + "\"");
      }
      return static_cast<int>(*value);
    };
    width = side(text.substr(0, x));
    height = side(x == std::string::npos ? "" : text.substr(x + 1));
  };
}

void AddInputs(CLI::App& app, ValidateOptions& options) {
  const auto add = [&app](const std::string& name, auto& value, const std::string& text) {
    return app.add_option(name, value, text)->type_name("FILE");
  };
  add("--object", options.object_path, "Object file, or the folder of the plans' object files")
      ->required();
  CLI::Option* plan =
      add("--plan", options.plans,
          "Plan file. - is standard input. Several files, a folder of plans (*.json) or a file of "
          "plan --batch (*.jsonl) are validated in parallel processes");
  CLI::Option* grasp =
      add("--grasp", options.grasp_path,
          "Validate a single grasp. Reports force closure, required friction angle, quality and "
          "the finger with the smallest friction margin, and simulates the grasp")
          ->excludes(plan);
  CLI::Option* grasps =
      add("--grasps", options.grasps_path,
          "Check many grasps in an NPZ file. Arrays points and normals (N, k, 3), or (N, k, 2) in "
          "the plane; active (N, k) is the mask of contacts. Normals can be omitted in the "
          "interior "
          "of faces. Writes verdicts.npz; with --replay points also simulates force-closure grasps")
          ->excludes(plan)
          ->excludes(grasp);
  ListOption("--compute")
      .Word("required-angle", [&options] { options.required_angle = true; })
      .Word("quality", [&options] { options.quality = true; })
      .AddTo(app, "required-angle|quality[,…]",
             "Also compute for --grasps.\n"
             "required-angle: required friction angle, 64 µs per grasp\n"
             "quality: grasp quality within 1 %, 0.1 ms per grasp")
      ->needs(grasps);
  add("--start", options.start, "Grasp file that the initial grasp must equal")->excludes(grasp);
  add("--goal", options.goal, "Grasp file that the goal grasp must equal")->excludes(grasp);
  add("--hand", options.hand,
      "Hand file of a hand plan. Also checks joint limits, fingertips and collisions along all "
      "paths")
      ->excludes(grasp);
  add("--verify", options.verify,
      "Check the certificates in a report of this plan. Uses exact rational arithmetic, simulates "
      "nothing and writes nothing")
      ->excludes(grasp);
  ListOption("--allow")
      .Word("object-change", [&options] { options.allow_object_change = true; })
      .Word("undecided", [&options] { options.allow_undecided = true; })
      .AddTo(app, "object-change|undecided[,…]",
             "Exceptions to permit.\n"
             "object-change: an object file with different content than the plan was made for\n"
             "undecided: sliding steps with up to a thousandth of a segment neither proved nor "
             "refuted");
}

void AddOutputs(CLI::App& app, ValidateOptions& options) {
  const auto add = [&app](const std::string& name, std::string& value, const std::string& text) {
    return app.add_option(name, value, text)->type_name("FILE");
  };
  add("-o,--output", options.out,
      "Folder for report and frames, verdicts or states. For several plans it has one folder per "
      "plan, index.html and summary.json; for a file of plans reports.jsonl [default: out/NAME of "
      "the input]")
      ->type_name("DIR");
  app.add_flag("--certificates", options.certificates,
               "Also write proofs of force closure into the report. Contact forces that prove it "
               "or a twist that refutes it, for every grasp and sliding step");
  add("--junit", options.junit, "Write the verdicts as JUnit XML");
  add("--json", options.json,
      "Write the report to this file too. - is standard output and replaces the table");
  add("--export-mjcf", options.mjcf,
      "Write the simulated scene as MJCF. With --replay hand a folder with scene.xml, one keyframe "
      "per static grasp, and meshes");
  add("--trajectory", options.trajectory,
      "Write the trajectory of the replay as CSV. Per finger time (s), position (m) and force (N); "
      "with --replay hand joints, controls and object pose, as NPZ if the file ends in .npz");
}

/// Add the options of the object and the fingers, in addition to the plan.
void AddBodies(CLI::App& app, ValidateOptions& options) {
  options.friction.AddTo(app);
  options.contact.AddTo(app, "that of the plan; 0 for grasps");
  BeginGroup(app, "Object and fingers");
  AddScale(app, options.scale,
           "Metres per length unit of the object file. Must be that of the plan; 1 for grasps by "
           "default");
  options.repair.AddWithSwitch(app);
  CLI::Option* mass =
      AddNumber(app, "--mass", options.replay.mass_kg, NumberRange::Positive(),
                "Mass of the object in kg. Replaces --density [default: that of the "
                "plan, if it has one]",
                "KG");
  AddNumber(app, "--density", options.replay.density_kg_m3, NumberRange::Positive(),
            "Density of the object in kg/m^3 [default: 1000, unless the plan has a mass]", "KG_M3")
      ->excludes(mass);
  AddNumber(app, "--thickness", options.replay.thickness, NumberRange::Positive(),
            "Thickness of a planar object, object units [default: a quarter of the diameter]");
  AddNumber(app, "--finger-radius", options.replay.finger_radius, NumberRange::Positive(),
            "Radius of the fingers, object units. A finger must reach its contact along the normal "
            "and not overlap others [default: that of the plan, otherwise 0]",
            "R");
  AddNumber(app, "--clearance", options.clearance_m, {0, 0.05, true, true},
            "Minimum distance of links from each other, palm and object. Metres, with --hand "
            "[default: 0.001]",
            "M");
}

void AddVideo(CLI::App& app, std::string& video) {
  const auto parse = [&video](const std::string& file) {
    if (!render::FindAnimationFormat(file) && LowerSuffix(file) != ".html") {
      throw CLI::ValidationError(
          "--video",
          "expected a name that ends in .mp4, .gif, .webp or .html, found \"" + file + "\"");
    }
    video = file;
  };
  app.add_option_function<std::string>(
         "--video", parse,
         "Write the replay to this file. .mp4 (H.264), .gif or "
         ".webp: an animation, which the HTML report also shows "
         "unless --frames animation is given; .html: the interactive 3-D "
         "replay")
      ->type_name("FILE");
}

constexpr char kAnimationSize[] = "--size animation";

void AddPictures(CLI::App& app, ValidateOptions& options) {
  ListOption("--frames", &options.settings)
      .Values("all, failed or none",
              {ChoiceParser<Frames>(
                  options.frames,
                  {{"all", Frames::kAll}, {"failed", Frames::kFailed}, {"none", Frames::kNone}})})
      .Key("viewer",
           ChoiceParser<ViewerPages>(options.viewer, {{"frames", ViewerPages::kWithFrames},
                                                      {"all", ViewerPages::kAll},
                                                      {"none", ViewerPages::kNone}}))
      .Word("animation", [&options] { options.animate = true; })
      .Key("object", ChoiceParser<bool>(options.frame.glass, {{"opaque", false}, {"glass", true}}))
      .AddTo(app, "all|failed|none[,viewer=frames|all|none][,object=opaque|glass][,animation]",
             "Which plans and grasps get frames [default: all; none for a file of plans]\n"
             "animation: also write the replay as replay.webp, which the HTML report shows\n"
             "viewer=frames|all|none: HTML reports with the interactive 3-D replay, those with "
             "frames by default\n"
             "object=opaque|glass: look of a solid. Fingers behind an opaque one shine through "
             "faintly [default: opaque]");
  ListOption("--show")
      .Word("focus", [&options] { options.frame.show_focus = true; })
      .Word("clusters", [&options] { options.show_clusters = true; })
      .AddTo(app, "focus|clusters[,…]",
             "Also draw in frames of a solid.\n"
             "focus: focus point of four concurrent contacts and their contact regions\n"
             "clusters: clusters of contact points and their representatives");
  options.frame.crop = true;
  const ListOption::Parser size = SizeParser(options.frame.width, options.frame.height);
  ListOption("--size", &options.settings)
      .Values("WxH", {[&options, size](const std::string& name, const std::string& text) {
                size(name, text);
                options.frame.crop = false;
              }})
      .Key("animation", SizeParser(options.animation_width, options.animation_height))
      .Key("overview",
           IntegerParser(options.sheet_width, render::kMinOverviewWidth, render::kMaxOverviewWidth))
      .AddTo(app, "WxH[,animation=WxH][,overview=W]",
             "Size of frames, pixels. By default frames are cropped to their content [default: " +
                 std::to_string(options.frame.width) + "x" + std::to_string(options.frame.height) +
                 "]\n"
                 "animation=WxH: size of animations [default: 1280x720]\n"
                 "overview=W: width of overview.png [default: 1600]");
  AddFrameView(app, options.frame);
  AddVideo(app, options.video);
}

/// Limit for the workers: each has two images with four samples per pixel in memory.
constexpr int kMostWorkers = 16;

constexpr char kSeveralPlans[] = "requires several plans, a folder or a file of plans (*.jsonl)";
constexpr char kSeveralPlansOrConditions[] =
    "requires several plans, a folder or a file of plans (*.jsonl), or --conditions";
constexpr char kSinglePlan[] = "requires a single plan or grasp";

/// Return the options that change no result: inputs, outputs and speed.
/// The contents of input files are compared separately.
const std::set<std::string>& ChangeNothing() {
  static const std::set<std::string> kNames = {
      "--help",   "--help-all", "--version",     "--object",     "--plan",  "--grasp", "--output",
      "--junit",  "--json",     "--export-mjcf", "--trajectory", "--start", "--goal",  "--hand",
      "--verify", "--jobs",     "--restart",     "--time-limit", "--quiet", "--video", "--shard"};
  return kNames;
}

}  // namespace

ValidateOptions::ValidateOptions() {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  jobs = std::clamp(cores, 1, kMostJobs);
  workers = std::clamp(cores, 1, kMostWorkers);
}

void ValidateOptions::AddTo(CLI::App& app) {
  BeginGroup(app, "Input");
  AddInputs(app, *this);
  BeginGroup(app, "Friction and contact");
  AddBodies(app, *this);
  BeginGroup(app, "Simulation");
  AddSimulation(app, *this);
  BeginGroup(app, "Reset states");
  AddStates(app, *this);
  BeginGroup(app, "Output");
  AddOutputs(app, *this);
  BeginGroup(app, "Pictures");
  AddPictures(app, *this);
  BeginGroup(app, "Many plans");
  AddBatch(app, *this);
  AddQuiet(app, quiet);
  MarkRare(app, {"--compute", "--verify", "--clearance", "--thickness", "--show", "--edges",
                 "--background", "--shard", "--trajectory", "--export-mjcf"});
  SetUsage(app,
           "--object FILE (--plan FILE… | --grasp FILE | --grasps FILE | --hand FILE "
           "--export-states N)");
  app.footer(
      "  validate --object cube.obj --plan plan.json\n"
      "  validate --object models --plan plans --output out/plans --frames none --junit "
      "junit.xml\n");
}

void ValidateOptions::Refuse(const CLI::App& app, std::initializer_list<const char*> names,
                             const std::string& why) const {
  for (const char* name : names) {
    // The name is an option, or a setting of an option.
    const bool setting = std::string(name).find(' ') != std::string::npos;
    if (setting ? settings.contains(name) : app.count(name) > 0) {
      throw InputError(std::string(name) + ": " + why);
    }
  }
}

void ValidateOptions::CheckPlans(const CLI::App& app) {
  if (!for_lines()) Refuse(app, {"--shard"}, "requires a file of plans (*.jsonl)");
  if (for_lines()) {
    Refuse(app,
           {"--trajectory", "--export-mjcf", "--verify", "--json", "--video", "--frames animation",
            "--junit"},
           "cannot be used with a file of plans (*.jsonl)");
    if (app.count("--frames") == 0) frames = Frames::kNone;
    plan_path = plans.front();
  } else if (for_batch()) {
    Refuse(app, {"--trajectory", "--export-mjcf", "--verify", "--json", "--video"}, kSinglePlan);
    if (std::ranges::find(plans, kStandardStream) != plans.end()) {
      throw InputError("--plan -: " + std::string(kSinglePlan));
    }
  } else {
    Refuse(app, {"--time-limit", "--restart"}, kSeveralPlans);
    if (conditions.empty()) Refuse(app, {"--jobs"}, kSeveralPlansOrConditions);
    if (!for_grasp()) plan_path = plans.front();
  }
}

void ValidateOptions::Finish(const CLI::App& app) {
  tolerance.length_m = 1e-3 * tolerance_mm;
  tolerance.angle_rad = Radians(tolerance_deg);
  if (app.count("--export-states") > 0) {
    CheckForStates(*this, app);
    return;
  }
  if (plans.empty() && grasp_path.empty() && grasps_path.empty()) {
    throw InputError("--plan, --grasp, --grasps or --export-states is required");
  }
  if (for_grasps()) {
    CheckForGrasps(*this, app);
    return;
  }
  if (for_grasp() && allow_object_change) {
    throw InputError("--allow object-change: a grasp file names no object");
  }
  CheckPlans(app);
  CheckSimulation(*this, app);
  if (!animates()) Refuse(app, {kAnimationSize}, "requires --frames animation or --video");
  given = GivenOptions(app, ChangeNothing());
}

bool ValidateOptions::trajectory_is_npz() const { return LowerSuffix(trajectory) == ".npz"; }

bool ValidateOptions::for_lines() const {
  return plans.size() == 1 && LowerSuffix(plans.front()) == ".jsonl";
}

bool ValidateOptions::for_batch() const {
  std::error_code error;
  return plans.size() > 1 ||
         (!plans.empty() && std::filesystem::is_directory(plans.front(), error));
}

const std::string& ValidateOptions::InputPath() const {
  if (for_states()) return object_path;
  return for_grasps() ? grasps_path : for_grasp() ? grasp_path : plan_path;
}

std::filesystem::path ValidateOptions::Folder() const {
  namespace fs = std::filesystem;
  if (!out.empty()) return out;
  const fs::path parent = "out";
  if (plan_path.empty() && plans.size() > 1) return parent / "batch";
  // Standard input has no file name.
  if (InputPath() == kStandardStream) return parent / "plan";
  if (!for_batch()) return parent / fs::path(InputPath()).stem();
  // The absolute path also has a last name for "plans/" and ".".
  const fs::path folder = fs::absolute(plans.front()).lexically_normal();
  const fs::path name = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
  return parent / (name.empty() ? fs::path("batch") : name);
}

}  // namespace regrasp::apps
