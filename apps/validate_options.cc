#include "apps/validate_options.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <set>
#include <system_error>
#include <thread>

#include "apps/help.h"
#include "apps/validate_modes.h"
#include "apps/view_options.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "render/picture/animation.h"

namespace regrasp::apps {

namespace {

/// Adds an option that takes a size in pixels, "1280x960".
CLI::Option* AddSize(CLI::App& app, const std::string& name, int& width, int& height,
                     const std::string& what, const std::string& usual) {
  const auto parse = [name, &width, &height](const std::string& text) {
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
  return app
      .add_option_function<std::string>(
          name, parse,
          what + ", pixels, each side from " + std::to_string(render::kMinFrameSide) + " to " +
              std::to_string(render::kMaxFrameSide) + " (default " + usual + ")")
      ->type_name("WxH");
}

void AddInputs(CLI::App& app, ValidateOptions& options) {
  const auto add = [&app](const std::string& name, auto& value, const std::string& text) {
    return app.add_option(name, value, text)->type_name("FILE");
  };
  add("--object", options.object_path,
      "Object file; or a folder, in which each plan's object is the file that it names")
      ->required();
  CLI::Option* plan = add("--plan", options.plans,
                          "Plan file, - for standard input; or several, or a folder of plans "
                          "(every *.json), each of which is "
                          "validated in a process of its own; or a file of lines (*.jsonl), as "
                          "plan --batch writes it; or --grasp");
  CLI::Option* grasp =
      add("--grasp", options.grasp_path,
          "Grasp file: asks for a single grasp, at the friction given here, whether it is force "
          "closure, the half-angle that it needs, its quality, and its weakest finger: the one "
          "whose own friction may fall least while all others keep theirs; holds and shakes it")
          ->excludes(plan);
  CLI::Option* grasps =
      add("--grasps", options.grasps_path,
          "NPZ file of many grasps: arrays points and normals of shape (N, k, 3), or (N, k, 2) in "
          "the plane; says of each whether it is on the object and force closure, by analysis "
          "alone, and writes verdicts.npz; normals may be left out in the interior of faces, and "
          "holds (N, k) says which contacts count. With --replay points also holds and shakes each "
          "that is force closure")
          ->excludes(plan)
          ->excludes(grasp);
  app.add_flag("--required-angle", options.required_angle,
               "With --grasps, also the half-angle that each needs; some 64 microseconds each")
      ->needs(grasps);
  app.add_flag("--quality", options.quality,
               "With --grasps, also the quality of each, within 1 %; about 0.1 ms each")
      ->needs(grasps);
  add("--start", options.start, "Grasp file that the plan's initial grasp must be")
      ->excludes(grasp);
  add("--goal", options.goal, "Grasp file that the plan's goal must be")->excludes(grasp);
  add("--hand", options.hand,
      "Hand file, of a plan for a hand: also check joints, limits, tips and collisions along all "
      "paths of the hand")
      ->excludes(grasp);
  AddNumber(app, "--clearance", options.clearance_m, {0, 0.05, true, true},
            "What links keep from each other, from the palm and from the object; in metres, with "
            "--hand (default 0.001)",
            "M");
  add("--verify", options.verify,
      "Check the proofs of a report that --certificates wrote: in exact rational arithmetic, "
      "against this plan and object, at the plan's friction or the one that is given, and all else "
      "that a plan must be; nothing is replayed or written")
      ->excludes(grasp);
}

void AddOutputs(CLI::App& app, ValidateOptions& options) {
  const auto add = [&app](const std::string& name, std::string& value, const std::string& text) {
    return app.add_option(name, value, text)->type_name("FILE");
  };
  add("--out", options.out,
      "Folder for report and frames, verdicts or states (default out/<plan, grasp or object "
      "name>); of several plans a folder "
      "for each in it, index.html and summary.json (default out/<folder name> or out/batch); of a "
      "file of lines reports.jsonl")
      ->type_name("DIR");
  app.add_flag("--certificates", options.certificates,
               "Also write proofs of force closure into the report: for every grasp and all along "
               "every align, contact forces that prove it, or a twist that refutes it");
  add("--junit", options.junit, "Write the verdicts as JUnit XML");
  add("--json", options.json,
      "Write the report here too; - is standard output, instead of the table");
  add("--export-mjcf", options.mjcf,
      "Write the scene of the replay as MJCF; without what versions of MuJoCo name differently. "
      "With --replay hand a folder: scene.xml, which has a keyframe for each rest, and the hand's "
      "meshes");
  add("--trajectory", options.trajectory,
      "Write what every finger does during the replay as CSV: time (s), place (m), force (N). With "
      "--replay hand what the hand does, as NPZ where the file ends in .npz, otherwise as CSV: "
      "time, joints (rad), "
      "controls of its actuators, the object's pose in the palm (m, quaternion)");
}

/// The object and the fingers, beside what the plan says of them.
void AddBodies(CLI::App& app, ValidateOptions& options) {
  options.friction.AddTo(app);
  options.contact.AddTo(app, "that of the plan; of grasps hard");
  AddScale(app, options.scale,
           "Metres per unit of length of the object file; must be the plan's, 1 for a grasp where "
           "left out");
  options.repair.AddWithSwitch(app);
  CLI::Option* mass = AddNumber(app, "--mass", options.replay.mass_kg, NumberRange::Positive(),
                                "Mass of the object, kg; instead of --density", "KG");
  AddNumber(app, "--density", options.replay.density_kg_m3, NumberRange::Positive(),
            "Density of the object, kg/m^3 (default 1000)", "KG_M3")
      ->excludes(mass);
  AddNumber(app, "--thickness", options.replay.thickness, NumberRange::Positive(),
            "Thickness of the prism that a planar object is: in the object file's own unit of "
            "length (default a quarter of the diameter)");
  AddNumber(app, "--finger-radius", options.replay.finger_radius, NumberRange::Positive(),
            "Radius of the fingers, in the object file's own unit of length: a finger that cannot "
            "come straight along the normal to its contact, or overlaps another, is unreachable "
            "(default that of the plan, otherwise fingers are points)",
            "R");
}

void AddSqueeze(CLI::App& app, sim::ReplayOptions& replay) {
  const auto parse = [&replay](const std::string& text) {
    replay.hand_squeeze = text == "realistic";
    if (!replay.hand_squeeze) {
      replay.squeeze_N = ParseNumber("--squeeze", text, NumberRange::Positive());
    }
  };
  app.add_option_function<std::string>(
         "--squeeze", parse,
         "Sum of the normal forces of a grasp at rest, newtons; or realistic: what a hand applies, "
         "twice what the weight needs in the grasp of the plan that carries it worst, at most 200 "
         "N (default: such that the weight is a tenth of the shake force, 1000 weights at the "
         "default shake)")
      ->type_name("N|realistic");
}

/// How the object is held, disturbed and examined.
void AddReplay(CLI::App& app, ValidateOptions& options) {
  AddSqueeze(app, options.replay);
  AddNumber(app, "--shake", options.replay.shake, NumberRange::NotNegative(),
            "Size of the shake: force over squeeze, and torque over squeeze times half the "
            "diameter (default 0.01)",
            "RHO");
  AddChoice<sim::EngineChoice>(
      app, "--engine", options.replay.engine,
      {{"mujoco", sim::EngineChoice::kMujoco},
       {"ode", sim::EngineChoice::kOde},
       {"both", sim::EngineChoice::kBoth}},
      "Physics engine of the replay: mujoco, or ode, the Open Dynamics Engine, with the same "
      "scene, "
      "motions and shakes, judged alike; both replays in both, MuJoCo decides, and every step on "
      "which they differ is named (default mujoco)");
  AddChoice<sim::Protocol>(
      app, "--protocol", options.replay.protocol,
      {{"adapted", sim::Protocol::kAdapted},
       {"fixed", sim::Protocol::kFixed},
       {"both", sim::Protocol::kBoth}},
      "How the fingers respond to the shake: adapted with forces planned for each "
      "direction, fixed with the forces of the rest and the stiffness of their servos "
      "alone; both runs both, the adapted one decides (default adapted)");
  app.add_flag("--stress", options.replay.stress,
               "Also find the largest push and turn that each rest resists: in every direction, by "
               "bisection in the replay and by analysis; takes some ten times as long");
  AddNumber(app, "--tolerance", options.replay.tolerance, NumberRange::Positive(),
            "How far the object may move and a fingertip slip; in diameters of the object "
            "(default 0.001)");
  AddChoice<sim::AlignChoice>(
      app, "--align", options.replay.align,
      {{"imitate", sim::AlignChoice::kImitate}, {"slide", sim::AlignChoice::kSlide}},
      "How aligns are carried out. imitate: spare fingers take over for each finger while it goes "
      "to its target. slide: a finger slides along the surface while the others alone hold the "
      "object, and is taken over for only where they do not (default imitate). Without a spare "
      "finger those that cannot slide roll, all at once");
}

/// Of the replay by a hand.
void AddHandReplay(CLI::App& app, ValidateOptions& options) {
  AddChoice<bool>(app, "--replay", options.replay_by_hand, {{"points", false}, {"hand", true}},
                  "Who carries the plan out: points, ideal fingers without a hand, or hand, the "
                  "model of --hand with its own actuators, gravity and friction (default hand "
                  "where --hand is given, otherwise points)");
  constexpr double kMetre = 1e3;
  AddNumber(app, "--tolerance-mm", options.tolerance_mm, {0, kMetre, false, true},
            "How far the object may be from its planned place; with --replay hand, half of it at "
            "rest (default 2)",
            "MM");
  AddNumber(app, "--tolerance-deg", options.tolerance_deg, {0, 180, false, true},
            "How far the object may be turned from its plan; with --replay hand, half of it at "
            "rest (default 5)",
            "DEG");
  AddChoice<bool>(app, "--feedback", options.feedback, {{"pose", true}, {"none", false}},
                  "What the hand knows of the object; with --replay hand. pose: joint targets are "
                  "corrected by its pose, as a camera sees it; none: they are not (default pose)");
  AddChoice<sim::TipShape>(
      app, "--tip", options.tip,
      {{"ball", sim::TipShape::kBall}, {"geometry", sim::TipShape::kGeometry}},
      "What of a fingertip touches the object; with --replay hand. ball: the ball of the hand's "
      "file, for which plans are made. geometry: what the model's tip link has for collisions "
      "(boxes, capsules, hulls of meshes); fingers are still placed, steered and held to their "
      "contacts as planned for balls, so that it tells whether such a plan holds (default ball)");
}

void AddTrialOptions(CLI::App& app, ValidateOptions& options) {
  constexpr int kMostTrials = 1'000'000;
  constexpr double kMostJointNoise = 45;
  const NumberRange share{0, sim::kMostError};
  CLI::Option* trials =
      AddInteger(app, "--trials", options.trials.count, 1, kMostTrials,
                 "Repeat the replay N times with noise in contacts, friction and mass. The plan "
                 "passes if the replay without noise does and --min-pass-rate of the trials do; "
                 "the verdict names how many");
  AddNumber(app, "--min-pass-rate", options.trials.min_pass_rate,
            {.lower = 0, .upper = 1, .lower_included = false},
            "Share of the trials that must pass, above 0 and at most 1 (default 1: all of them)",
            "RATE")
      ->needs(trials);
  AddSeed(app, options.trials.seed,
          "Seed of the noise, or of what --export-states draws (default 0)");
  AddNumber(app, "--position-noise", options.trials.position_noise, share,
            "Standard deviation of each contact along the surface; in diameters of the object "
            "(default 0.01). With --replay hand of where the object is at first, along each axis, "
            "and about it over half the diameter")
      ->needs(trials);
  AddNumber(app, "--friction-error", options.trials.friction_error, share,
            "Relative standard deviation of the friction coefficient (default 0.1)")
      ->needs(trials);
  AddNumber(app, "--mass-error", options.trials.mass_error, share,
            "Relative standard deviation of the mass (default 0.1)")
      ->needs(trials);
  AddNumber(app, "--joint-noise", options.joint_noise_deg, {0, kMostJointNoise},
            "Standard deviation of what the hand takes a joint's angle for; degrees, of --replay "
            "hand (default 0.5)",
            "DEG")
      ->needs(trials);
}

void AddVideo(CLI::App& app, std::string& video) {
  const auto parse = [&video](const std::string& file) {
    if (!render::FindAnimationFormat(file)) {
      throw CLI::ValidationError("--video",
                                 "\"" + file + "\" is no name that ends in .mp4, .gif or .webp");
    }
    video = file;
  };
  app.add_option_function<std::string>("--video", parse,
                                       "Write the replay as a moving picture into this file: .mp4 "
                                       "(H.264), .gif or .webp; without "
                                       "--animate it is the one that the report page shows")
      ->type_name("FILE");
}

constexpr char kAnimateSize[] = "--animate-size";

void AddPictures(CLI::App& app, ValidateOptions& options) {
  CLI::Option* none = app.add_flag_callback(
      "--no-frames", [&options] { options.frames = Frames::kNone; }, "Draw no frames");
  AddChoice<Frames>(
      app, "--frames", options.frames,
      {{"all", Frames::kAll}, {"failed", Frames::kFailed}, {"none", Frames::kNone}},
      "Which plans and grasps get frames; all, those that failed, or none (default all; of a file "
      "of lines none, and those that get frames have a folder each)")
      ->excludes(none);
  app.add_flag(
      "--show-focus", options.frame.show_focus,
      "Also show the focus point of four concurrent contacts: in frames of a solid, with the "
      "lines to it and the contact regions that it gives");
  app.add_flag(
      "--show-clusters", options.show_clusters,
      "Also show the clusters of a plan over clustered contact points: on the surface, with "
      "their representatives as dots");
  options.frame.crop = true;
  AddSize(app, "--size", options.frame.width, options.frame.height,
          "Size of the frames. Without it they are at most as large as the default, and cropped to "
          "what is drawn",
          std::to_string(options.frame.width) + "x" + std::to_string(options.frame.height))
      ->each([&options](const std::string& /*size*/) { options.frame.crop = false; });
  AddInteger(
      app, "--sheet-width", options.sheet_width, render::kMinOverviewWidth,
      render::kMaxOverviewWidth,
      "Width of the contact sheet overview.png, pixels; frames are not enlarged for it (default "
      "1600)");
  AddFrameView(app, options.frame);
  app.add_flag("--animate", options.animate,
               "Also write the whole replay as a moving picture: replay.webp, slowed down and seen "
               "as the frames are; the report page shows it")
      ->excludes(none);
  AddVideo(app, options.video);
  AddSize(app, kAnimateSize, options.animation_width, options.animation_height,
          "Size of moving pictures", "half of --size");
}

/// Each keeps two pictures of four samples a pixel in memory.
constexpr int kMostWorkers = 16;

constexpr char kSeveralPlans[] = "goes with several plans, a folder or a file of lines";
constexpr char kSinglePlan[] = "goes with a single plan or grasp";

/// Options that say where things come from, where they go and how fast; --start and --goal count
/// by what their files hold.
const std::set<std::string>& ChangeNothing() {
  static const std::set<std::string> kNames = {
      "--help", "--version",     "--object",     "--plan",  "--grasp", "--out",  "--junit",
      "--json", "--export-mjcf", "--trajectory", "--start", "--goal",  "--hand", "--verify",
      "--jobs", "--fresh",       "--time-limit", "--quiet", "--video", "--shard"};
  return kNames;
}

}  // namespace

ValidateOptions::ValidateOptions() {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  jobs = std::clamp(cores, 1, kMostJobs);
  workers = std::clamp(cores, 1, kMostWorkers);
}

void ValidateOptions::AddTo(CLI::App& app) {
  BeginGroup(app, "Object, and what is validated");
  AddInputs(app, *this);
  BeginGroup(app, "Results");
  AddOutputs(app, *this);
  BeginGroup(app, "Friction, body and fingers");
  AddBodies(app, *this);
  BeginGroup(app, "Replay");
  AddReplay(app, *this);
  BeginGroup(app, "Replay by a hand");
  AddHandReplay(app, *this);
  BeginGroup(app, "Trials with noise");
  AddTrialOptions(app, *this);
  BeginGroup(app, "Reset states");
  AddStates(app, *this);
  BeginGroup(app, "Pictures");
  AddPictures(app, *this);
  BeginGroup(app, "Several plans");
  AddBatch(app, *this);
  BeginGroup(app, "What is let pass");
  app.add_flag("--allow-object-change", allow_object_change,
               "Accept an object file with other bytes than the plan was made for");
  app.add_flag("--allow-undecided", allow_undecided,
               "Pass aligns that are proved but for a little: up to a thousandth of a segment "
               "between two waypoints is neither proved nor refuted; otherwise they fail as "
               "not-proved");
  AddQuiet(app, quiet);
  app.footer(
      "  validate --object cube.obj --plan plan.json\n"
      "  validate --object models --plan plans --out out/plans --no-frames --junit junit.xml\n");
}

void ValidateOptions::Finish(const CLI::App& app) {
  tolerance.length_m = 1e-3 * tolerance_mm;
  tolerance.angle_rad = Radians(tolerance_deg);
  if (for_states()) {
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
    throw InputError("--allow-object-change: a grasp file names no object");
  }
  const auto refuse = [&app](std::initializer_list<const char*> names, const std::string& why) {
    for (const char* name : names) {
      if (app.count(name) > 0) throw InputError(std::string(name) + " " + why);
    }
  };
  if (!for_lines()) refuse({"--shard"}, "goes with a file of lines");
  if (for_lines()) {
    refuse(
        {"--trajectory", "--export-mjcf", "--verify", "--json", "--video", "--animate", "--junit"},
        "does not go with a file of lines");
    if (app.count("--frames") == 0) frames = Frames::kNone;
    plan_path = plans.front();
  } else if (for_batch()) {
    refuse({"--trajectory", "--export-mjcf", "--verify", "--json", "--video"}, kSinglePlan);
    if (std::ranges::find(plans, kStandardStream) != plans.end()) {
      throw InputError("--plan - " + std::string(kSinglePlan));
    }
  } else {
    refuse({"--jobs", "--time-limit", "--fresh"}, kSeveralPlans);
    if (!for_grasp()) plan_path = plans.front();
  }
  if (app.count("--replay") == 0) replay_by_hand = !hand.empty();
  if (replay_by_hand) {
    if (hand.empty()) throw InputError("--replay hand: needs the hand (--hand)");
    refuse({"--engine", "--protocol", "--stress", "--tolerance", "--align", "--finger-radius"},
           "goes with --replay points");
  } else {
    refuse({"--tolerance-mm", "--tolerance-deg", "--feedback", "--tip", "--joint-noise"},
           "goes with --replay hand");
    if (trajectory_is_npz()) {
      throw InputError("--trajectory: " + trajectory + ": NPZ goes with --replay hand");
    }
  }
  if (trials.count == 0) refuse({"--seed"}, "goes with --trials or --export-states");
  if (replay_by_hand) trials.joint_noise = Radians(joint_noise_deg);
  if (!animates()) refuse({kAnimateSize}, "goes with --animate or --video");
  animation_crop = frame.crop && animation_width == 0;
  if (animation_width == 0) {
    animation_width = std::max(render::kMinFrameSide, frame.width / 2);
    animation_height = std::max(render::kMinFrameSide, frame.height / 2);
  }
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
  // What comes by standard input has no name.
  if (InputPath() == kStandardStream) return parent / "plan";
  if (!for_batch()) return parent / fs::path(InputPath()).stem();
  // "plans/" and "." have names too.
  const fs::path folder = fs::absolute(plans.front()).lexically_normal();
  const fs::path name = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
  return parent / (name.empty() ? fs::path("batch") : name);
}

}  // namespace regrasp::apps
