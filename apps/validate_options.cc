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
  CLI::Option* mass = AddNumber(app, "--mass", options.replay.mass_kg, NumberRange::Positive(),
                                "Mass of the object in kg. Replaces --density", "KG");
  AddNumber(app, "--density", options.replay.density_kg_m3, NumberRange::Positive(),
            "Density of the object in kg/m^3 [default: 1000]", "KG_M3")
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

void AddGraspForce(CLI::App& app, sim::ReplayOptions& replay) {
  const auto parse = [&replay](const std::string& text) {
    replay.hand_grasp_force = text == "realistic";
    if (!replay.hand_grasp_force) {
      replay.grasp_force_N = ParseNumber("--grasp-force", text, NumberRange::Positive());
    }
  };
  app.add_option_function<std::string>(
         "--grasp-force", parse,
         "Sum of the normal forces of a static grasp, newtons. realistic: twice what the weight "
         "requires in the weakest grasp, at most 200 N. By default the weight is a tenth of the "
         "disturbance force")
      ->type_name("N|realistic");
}

void AddDisturbance(CLI::App& app, ValidateOptions& options) {
  ListOption("--disturbance")
      .Values("a number",
              {NumberParser(options.replay.disturbance_ratio, NumberRange::NotNegative())})
      .Word("limits", [&options] { options.replay.resisted_wrench = true; })
      .AddTo(app, "RHO[,limits]",
             "Size of the disturbance test. Force over grasp force, and torque over grasp force "
             "times half the diameter [default: 0.01]\n"
             "limits: also find the largest resisted force and torque in every direction, about "
             "ten times as slow");
}

/// Parse a tolerance: "0.001" (object diameters), "2mm" or "5deg".
void ParseTolerance(ValidateOptions& options, const std::string& name, const std::string& text) {
  constexpr double kMetre_mm = 1e3, kHalfTurn_deg = 180;
  const std::size_t end = text.find_first_not_of("0123456789.+-eE");
  // The number parser would read "2e" as a number with an exponent.
  const std::string unit = end == std::string::npos ? "" : text.substr(end);
  const std::string number = text.substr(0, end);
  if (!options.settings.insert(name + " " + (unit.empty() ? "diameters" : unit)).second) {
    throw CLI::ValidationError(name, "found two tolerances of one kind, expected one");
  }
  if (unit.empty()) {
    options.replay.tolerance = ParseNumber(name, number, NumberRange::Positive());
  } else if (unit == "mm") {
    options.tolerance_mm = ParseNumber(name, number, {0, kMetre_mm, false, true});
  } else if (unit == "deg") {
    options.tolerance_deg = ParseNumber(name, number, {0, kHalfTurn_deg, false, true});
  } else {
    throw CLI::ValidationError(
        name, "expected a number, or one with the unit mm or deg, found \"" + text + "\"");
  }
}

/// Return a parser of an angle in degrees, stored in radians.
ListOption::Parser DegreesParser(double& radians) {
  return [&radians](const std::string& name, const std::string& text) {
    constexpr double kHalfTurn_deg = 180;
    radians = Radians(ParseNumber(name, text, {0, kHalfTurn_deg}));
  };
}

/// Return a parser of a length in millimetres, stored in metres.
ListOption::Parser MillimetresParser(double& metres) {
  return [&metres](const std::string& name, const std::string& text) {
    constexpr double kMetre_mm = 1e3;
    metres = ParseNumber(name, text, {0, kMetre_mm}) / kMetre_mm;
  };
}

void AddFeedback(CLI::App& app, ValidateOptions& options) {
  constexpr double kMostDelay_s = 10;
  constexpr double kMostRate_Hz = 10'000;
  sim::HandSensing& sensing = options.sensing;
  ListOption("--feedback", &options.settings)
      .Word("pose", [&sensing] { sensing.feedback = sim::PoseFeedback::kPose; })
      .Word("none", [&sensing] { sensing.feedback = sim::PoseFeedback::kNone; })
      .Key("delay", NumberParser(sensing.pose_delay_s, {0, kMostDelay_s}))
      .Key("rate", NumberParser(sensing.pose_rate_Hz,
                                {.lower = 0, .upper = kMostRate_Hz, .lower_included = false}))
      .Key("noise-mm", MillimetresParser(sensing.pose_noise_m))
      .Key("noise-deg", DegreesParser(sensing.pose_noise_rad))
      .Key("bias-mm", MillimetresParser(sensing.pose_bias_m))
      .Key("bias-deg", DegreesParser(sensing.pose_bias_rad))
      .AddTo(app, "pose|none[,KEY=VALUE,…]",
             "Measured object pose in the hand replay [default: pose]\n"
             "pose: a camera; none: joints and touch only\n"
             "delay=S: age of a measured pose [default: 0.05]\n"
             "rate=HZ: measured poses per second [default: 30]\n"
             "noise-mm=MM, noise-deg=DEG: standard deviations per axis [default: 0.3, 0.3]\n"
             "bias-mm=MM, bias-deg=DEG: standard deviations of constant errors per axis [default: "
             "0, 0]");
}

void AddReplay(CLI::App& app, ValidateOptions& options) {
  ListOption("--replay", &options.settings)
      .Word("points", [&options] { options.replay_by_hand = false; })
      .Word("hand", [&options] { options.replay_by_hand = true; })
      .Key("align", ChoiceParser<sim::AlignChoice>(options.replay.align,
                                                   {{"imitate", sim::AlignChoice::kImitate},
                                                    {"slide", sim::AlignChoice::kSlide}}))
      .Key("tip",
           ChoiceParser<sim::TipShape>(options.tip, {{"ball", sim::TipShape::kBall},
                                                     {"geometry", sim::TipShape::kGeometry}}))
      // Old form of --feedback, accepted for one version.
      .Key("feedback", ChoiceParser<sim::PoseFeedback>(options.sensing.feedback,
                                                       {{"pose", sim::PoseFeedback::kPose},
                                                        {"none", sim::PoseFeedback::kNone}}))
      .AddTo(app, "points|hand[,KEY=VALUE,…]",
             "Simulation model that executes the plan [default: hand with --hand, otherwise "
             "points]\n"
             "points: ideal point fingers\n"
             "hand: the model of --hand with its actuators, gravity and friction\n"
             "align=imitate|slide (points): free fingers take over while a finger is "
             "repositioned, or fingers slide along the surface [default: imitate]\n"
             "tip=ball|geometry (hand): collision shape of fingertips, the sphere of the hand file "
             "or the geoms of the model [default: ball]");
  AddFeedback(app, options);
  AddChoice<sim::EngineChoice>(app, "--engine", options.replay.engine,
                               {{"mujoco", sim::EngineChoice::kMujoco},
                                {"ode", sim::EngineChoice::kOde},
                                {"both", sim::EngineChoice::kBoth}},
                               "Physics engine of the replay [default: mujoco]\n"
                               "ode: Open Dynamics Engine with the same scene and disturbances\n"
                               "both: MuJoCo decides, and differing steps are listed");
  AddGraspForce(app, options.replay);
  AddDisturbance(app, options);
  AddChoice<sim::Protocol>(app, "--protocol", options.replay.protocol,
                           {{"adapted", sim::Protocol::kAdapted},
                            {"fixed", sim::Protocol::kFixed},
                            {"both", sim::Protocol::kBoth}},
                           "Response of the fingers to the disturbance [default: adapted]\n"
                           "adapted: forces planned per direction\n"
                           "fixed: constant forces and servo stiffness\n"
                           "both: adapted decides");
  ListOption("--tolerance")
      .AnyValue([&options](const std::string& name, const std::string& text) {
        ParseTolerance(options, name, text);
      })
      .AddTo(app, "X|MMmm,DEGdeg",
             "Tolerances of object motion [default: 0.001 or 2mm,5deg]\n"
             "X (--replay points): object diameters, also for fingertip slip\n"
             "MMmm, DEGdeg (--replay hand): displacement and rotation, half of them for static "
             "grasps");
}

void AddTrialOptions(CLI::App& app, ValidateOptions& options) {
  constexpr int kMostTrials = 1'000'000;
  constexpr double kMostJointNoise_deg = 45;
  const NumberRange share{0, sim::kMostError};
  CLI::Option* trials =
      ListOption("--trials")
          .Values("the number of trials", {IntegerParser(options.trials.count, 1, kMostTrials)})
          .Key("min-pass-rate", NumberParser(options.trials.min_pass_rate,
                                             {.lower = 0, .upper = 1, .lower_included = false}))
          .AddTo(app, "N[,min-pass-rate=RATE]",
                 "Repeat the replay N times with noise. The replay without noise must pass too\n"
                 "min-pass-rate=RATE: required share of passing trials [default: 1]");
  ListOption("--noise", &options.settings)
      .Key("position", NumberParser(options.trials.position_noise, share))
      .Key("friction", NumberParser(options.trials.friction_error, share))
      .Key("mass", NumberParser(options.trials.mass_error, share))
      .Key("joints", NumberParser(options.joint_noise_deg, {0, kMostJointNoise_deg}))
      .AddTo(app, "KEY=VALUE,…",
             "Standard deviations of the noise of --trials.\n"
             "position=X: contacts along the surface, with --replay hand the initial object pose, "
             "in object diameters [default: 0.01]\n"
             "friction=X: relative error of the friction coefficient [default: 0.1]\n"
             "mass=X: relative error of the mass [default: 0.1]\n"
             "joints=DEG (--replay hand): measured joint angles [default: 0.5]")
      ->needs(trials);
  app.add_option("--conditions", options.conditions,
                 "Replay by the hand also under each of several conditions [default: "
                 "nominal]\n"
                 "nominal: none\n"
                 "standard: sensors, friction, mass, actuators and contact models that differ "
                 "(docs/conditions.md)\n"
                 "FILE: conditions in JSON (docs/conditions.schema.json)")
      ->type_name("nominal|standard|FILE");
  app.add_option("--require", options.require,
                 "Let the verdict depend on conditions. SHARE is the share that must pass "
                 "[default: 1]\n"
                 "standard: those of --conditions standard\n"
                 "conditions: those of --conditions FILE")
      ->type_name("standard|conditions[=SHARE]");
  AddSeed(app, options.trials.seed, "Random seed of --trials or --export-states [default: 0]");
}

void AddVideo(CLI::App& app, std::string& video) {
  const auto parse = [&video](const std::string& file) {
    if (!render::FindAnimationFormat(file) && !file.ends_with(".html")) {
      throw CLI::ValidationError(
          "--video",
          "expected a name that ends in .mp4, .gif, .webp or .html, found \"" + file + "\"");
    }
    video = file;
  };
  app.add_option_function<std::string>("--video", parse,
                                       "Write the replay to this file. .mp4 (H.264), .gif or "
                                       ".webp: an animation, which the HTML report also shows "
                                       "unless --animate is given; .html: the interactive 3-D "
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
      .Key("object", ChoiceParser<bool>(options.frame.glass, {{"opaque", false}, {"glass", true}}))
      .AddTo(app, "all|failed|none[,viewer=frames|all|none][,object=opaque|glass]",
             "Which plans and grasps get frames [default: all; none for a file of plans]\n"
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
  app.add_flag("--animate", options.animate,
               "Also write the replay as an animation, replay.webp. The HTML report shows it");
  AddVideo(app, options.video);
}

/// Limit for the workers: each has two images with four samples per pixel in memory.
constexpr int kMostWorkers = 16;

constexpr char kConditionsWord[] = "conditions";
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
  AddReplay(app, *this);
  AddTrialOptions(app, *this);
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
    Refuse(
        app,
        {"--trajectory", "--export-mjcf", "--verify", "--json", "--video", "--animate", "--junit"},
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
    if (conditions.empty() && require.empty()) Refuse(app, {"--jobs"}, kSeveralPlansOrConditions);
    if (!for_grasp()) plan_path = plans.front();
  }
}

void ValidateOptions::CheckReplay(const CLI::App& app) {
  if (!settings.contains("--replay points") && !settings.contains("--replay hand")) {
    replay_by_hand = !hand.empty();
  }
  if (settings.contains("--replay points") && settings.contains("--replay hand")) {
    throw InputError("--replay: found points and hand, expected one of them");
  }
  if (replay_by_hand) {
    if (hand.empty()) throw InputError("--replay hand: requires --hand");
    if (replay.resisted_wrench) throw InputError("--disturbance limits: requires --replay points");
    Refuse(app, {"--protocol", "--tolerance diameters", "--replay align", "--finger-radius"},
           "requires --replay points");
    if (replay.engine == sim::EngineChoice::kOde) {
      Refuse(app, {"--trajectory", "--export-mjcf"}, "requires --engine mujoco or both");
    }
    trials.joint_noise = Radians(joint_noise_deg);
    return;
  }
  Refuse(app,
         {"--tolerance mm", "--tolerance deg", "--feedback", "--replay feedback", "--replay tip",
          "--noise joints"},
         "requires --replay hand");
  if (trajectory_is_npz()) {
    throw InputError("--trajectory: " + trajectory + ": NPZ format requires --replay hand");
  }
}

void ValidateOptions::CheckConditions(const CLI::App& app) {
  constexpr char kNominal[] = "nominal";
  constexpr char kStandard[] = "standard";
  if (!replay_by_hand) Refuse(app, {"--conditions", "--require"}, "requires --replay hand");
  if (!require.empty()) {
    const std::size_t sign = require.find('=');
    const std::string word = require.substr(0, sign);
    if (word != kStandard && word != kConditionsWord) {
      throw InputError("--require: expected standard or conditions, found \"" + word + "\"");
    }
    required_conditions = 1;
    if (sign != std::string::npos) {
      const std::string text = require.substr(sign + 1);
      required_conditions = ParseDouble(text);
      if (!(required_conditions && *required_conditions > 0 && *required_conditions <= 1)) {
        throw InputError("--require: share must be above 0 and at most 1, found \"" + text + "\"");
      }
    }
    if (word == kStandard && conditions.empty()) conditions = kStandard;
    if (word == kStandard && conditions != kStandard) {
      throw InputError("--require standard: cannot be used with --conditions " + conditions +
                       ", expected --require conditions");
    }
    if (conditions.empty() || conditions == kNominal) {
      throw InputError("--require conditions: requires --conditions FILE");
    }
  }
  if (conditions.empty() || conditions == kNominal) return;
  if (conditions == kStandard) {
    condition_list = sim::StandardConditions();
    return;
  }
  const std::string text = ReadFile(conditions);
  conditions_sha256 = Sha256(text);
  condition_list = sim::ReadConditions(text, conditions);
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
  CheckReplay(app);
  CheckConditions(app);
  if (trials.count == 0) {
    Refuse(app, {"--trials"}, "the number of trials is required, as in --trials 20");
    Refuse(app, {"--seed"}, "requires --trials or --export-states");
  }
  if (!animates()) Refuse(app, {kAnimationSize}, "requires --animate or --video");
  given = GivenOptions(app, ChangeNothing());
}

bool ValidateOptions::trajectory_is_npz() const { return trajectory.ends_with(".npz"); }

bool ValidateOptions::for_lines() const {
  return plans.size() == 1 && plans.front().ends_with(".jsonl");
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
