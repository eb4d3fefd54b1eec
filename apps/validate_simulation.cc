#include "apps/validate_simulation.h"

#include <cstddef>
#include <string>

#include "apps/list_option.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "sim/actuation/hand_replay.h"

namespace regrasp::apps {

namespace {

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
  const auto response = [&options](sim::Protocol protocol) {
    return [&options, protocol] { options.replay.protocol = protocol; };
  };
  ListOption("--disturbance", &options.settings)
      .Values("a number",
              {NumberParser(options.replay.disturbance_ratio, NumberRange::NotNegative())})
      .Word("adapted", response(sim::Protocol::kAdapted))
      .Word("fixed", response(sim::Protocol::kFixed))
      .Word("both", response(sim::Protocol::kBoth))
      .Word("limits", [&options] { options.replay.resisted_wrench = true; })
      .AddTo(
          app, "RHO[,adapted|fixed|both][,limits]",
          "Size of the disturbance test and response of the fingers. Force over grasp force, and "
          "torque over grasp force times half the diameter [default: 0.01,adapted]\n"
          "adapted: forces planned per direction\n"
          "fixed: constant forces and servo stiffness\n"
          "both: adapted decides\n"
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
             "pose: a camera; none: joints and touch only, without settings\n"
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

void AddTrials(CLI::App& app, ValidateOptions& options) {
  constexpr int kMostTrials = 1'000'000;
  constexpr double kMostJointNoise_deg = 45;
  const NumberRange share{0, sim::kMostError};
  ListOption("--trials", &options.settings)
      .Values("the number of trials", {IntegerParser(options.trials.count, 1, kMostTrials)})
      .Key("min-pass-rate", NumberParser(options.trials.min_pass_rate,
                                         {.lower = 0, .upper = 1, .lower_included = false}))
      .Key("position", NumberParser(options.position_noise, share))
      .Key("friction", NumberParser(options.trials.friction_error, share))
      .Key("mass", NumberParser(options.trials.mass_error, share))
      .Key("joints", NumberParser(options.joint_noise_deg, {0, kMostJointNoise_deg}))
      .AddTo(app, "N[,KEY=VALUE,…]",
             "Repeat the replay N times with noise. The replay without noise must pass too. The "
             "settings except min-pass-rate are standard deviations\n"
             "min-pass-rate=RATE: required share of passing trials [default: 1]\n"
             "position=X: contacts along the surface, with --replay hand the initial object pose, "
             "in object diameters [default: 0.01, with --replay hand 0.003]\n"
             "friction=X: relative error of the friction coefficient [default: 0.1]\n"
             "mass=X: relative error of the mass [default: 0.1]\n"
             "joints=DEG (--replay hand): measured joint angles [default: 0.5]");
}

void AddConditions(CLI::App& app, ValidateOptions& options) {
  ListOption("--conditions", &options.settings)
      .Values("nominal, standard or a file",
              {[&options](const std::string& /*name*/, const std::string& text) {
                options.conditions = text;
              }})
      .Word("require", [&options] { options.required_conditions = 1; })
      .Key("require", NumberParser(options.required_conditions,
                                   {.lower = 0, .upper = 1, .lower_included = false}))
      .AddTo(app, "nominal|standard|FILE[,require[=SHARE]]",
             "Replay by the hand also under each of several conditions [default: nominal]\n"
             "nominal: none\n"
             "standard: sensors, friction, mass, actuators and contact models that differ "
             "(docs/conditions.md)\n"
             "FILE: conditions in JSON (docs/conditions.schema.json)\n"
             "require=SHARE: a pass also requires that this share of the conditions passes, all "
             "of them by default");
}

/// Check that the disturbance test has one response.
/// @throws InputError  if several are given.
void CheckResponse(const ValidateOptions& options) {
  std::string first;
  for (const std::string response : {"adapted", "fixed", "both"}) {
    if (!options.settings.contains("--disturbance " + response)) continue;
    if (!first.empty()) {
      throw InputError("--disturbance: found " + first + " and " + response +
                       ", expected one of them");
    }
    first = response;
  }
}

/// Check that no setting of a measured pose is given without such a pose.
/// @throws InputError  if one is given, or both kinds of feedback.
void CheckFeedback(const ValidateOptions& options) {
  if (options.settings.contains("--feedback pose") &&
      options.settings.contains("--feedback none")) {
    throw InputError("--feedback: found pose and none, expected one of them");
  }
  if (options.sensing.feedback == sim::PoseFeedback::kPose) return;
  for (const char* key : {"delay", "rate", "noise-mm", "noise-deg", "bias-mm", "bias-deg"}) {
    if (options.settings.contains(std::string("--feedback ") + key)) {
      throw InputError(std::string("--feedback ") + key + ": cannot be used with --feedback none");
    }
  }
}

void CheckReplay(ValidateOptions& options, const CLI::App& app) {
  if (!options.settings.contains("--replay points") &&
      !options.settings.contains("--replay hand")) {
    options.replay_by_hand = !options.hand.empty();
  }
  if (options.settings.contains("--replay points") && options.settings.contains("--replay hand")) {
    throw InputError("--replay: found points and hand, expected one of them");
  }
  CheckResponse(options);
  options.trials.position_noise = options.position_noise.value_or(
      options.replay_by_hand ? sim::kHandPositionNoise : sim::TrialOptions().position_noise);
  if (options.replay_by_hand) {
    if (options.hand.empty()) throw InputError("--replay hand: requires --hand");
    if (options.replay.resisted_wrench)
      throw InputError("--disturbance limits: requires --replay points");
    options.Refuse(app,
                   {"--disturbance adapted", "--disturbance fixed", "--disturbance both",
                    "--tolerance diameters", "--replay align", "--finger-radius"},
                   "requires --replay points");
    if (options.replay.engine == sim::EngineChoice::kOde) {
      options.Refuse(app, {"--trajectory", "--export-mjcf"}, "requires --engine mujoco or both");
    }
    CheckFeedback(options);
    options.trials.joint_noise = Radians(options.joint_noise_deg);
    return;
  }
  for (const char* setting : {"--tolerance mm", "--tolerance deg", "--feedback", "--replay tip",
                              "--replay feedback", "--trials joints"}) {
    options.Refuse(app, {setting}, "requires --replay hand");
  }
  if (options.trajectory_is_npz()) {
    throw InputError("--trajectory: " + options.trajectory + ": NPZ format requires --replay hand");
  }
}

void CheckConditions(ValidateOptions& options, const CLI::App& app) {
  constexpr char kNominal[] = "nominal";
  constexpr char kStandard[] = "standard";
  if (app.count("--conditions") == 0) return;
  if (!options.replay_by_hand) options.Refuse(app, {"--conditions"}, "requires --replay hand");
  const bool nominal = options.conditions.empty() || options.conditions == kNominal;
  if (nominal && options.required_conditions) {
    throw InputError("--conditions require: requires standard or a file of conditions");
  }
  if (nominal) return;
  if (options.conditions == kStandard) {
    options.condition_list = sim::StandardConditions();
    return;
  }
  const std::string text = ReadFile(options.conditions);
  options.conditions_sha256 = Sha256(text);
  options.condition_list = sim::ReadConditions(text, options.conditions);
}

}  // namespace

void AddSimulation(CLI::App& app, ValidateOptions& options) {
  AddReplay(app, options);
  AddTrials(app, options);
  AddConditions(app, options);
  AddSeed(app, options.trials.seed, "Random seed of --trials or --export-states [default: 0]");
}

void CheckSimulation(ValidateOptions& options, const CLI::App& app) {
  CheckReplay(options, app);
  CheckConditions(options, app);
  if (options.trials.count > 0) return;
  options.Refuse(app, {"--trials"}, "the number of trials is required, as in --trials 20");
  options.Refuse(app, {"--seed"}, "requires --trials or --export-states");
}

}  // namespace regrasp::apps
