#include "apps/validate_modes.h"

#include <set>
#include <string>

#include "apps/list_option.h"
#include "planner/base/error.h"

namespace regrasp::apps {
namespace {

/// Refuse all given options except some.
/// @param why  text that follows the name of a refused option.
/// @throws InputError  if an option is given that is not in `served`.
void RefuseOthers(const CLI::App& app, const std::set<std::string>& served,
                  const std::string& why) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && !served.contains(name)) throw InputError(name + ": " + why);
  }
}

/// Largest time limit.
/// It exceeds the time of any plan, and clocks can add it without overflow.
constexpr double kLongestTime_s = 1e6;

}  // namespace

void AddBatch(CLI::App& app, ValidateOptions& options) {
  app.add_option("--shard", options.shard,
                 "Part I of N of a file of plans (*.jsonl). `merge` joins the results")
      ->type_name("I/N");
  AddInteger(app, "-j,--jobs", options.jobs, 1, kMostJobs,
             "Number of parallel validations, or threads of --export-states "
             "[default: one per processor]");
  AddNumber(app, "--time-limit", options.time_limit_s,
            {.lower = 0, .upper = kLongestTime_s, .lower_included = false},
            "Time limit per plan in seconds. A plan that exceeds it counts as an error", "S");
  app.add_flag("--restart", options.fresh,
               "Discard results of an earlier run. Otherwise a plan is validated again only if its "
               "inputs, the options or the program changed");
}

void AddStates(CLI::App& app, ValidateOptions& options) {
  // Maximum number of states; the file of a million states has about 700 MB.
  constexpr int kMostStates = 1'000'000;
  ListOption("--export-states")
      .Values("the number of states", {IntegerParser(options.states, 1, kMostStates)})
      .Key("min-quality", NumberParser(options.min_quality, {0, 1}))
      .AddTo(app, "N[,min-quality=Q]",
             "Sample N static grasps with the hand and write them to states.npz. Each is verified "
             "to hold the object for 1 s in simulation\n"
             "min-quality=Q: minimum grasp quality [default: 0.01]");
}

void CheckForGrasps(ValidateOptions& options, const CLI::App& app) {
  const std::set<std::string> of_replay = {"--mass",          "--density",     "--thickness",
                                           "--finger-radius", "--grasp-force", "--tolerance",
                                           "--engine",        "--disturbance"};
  std::set<std::string> served = {"--object", "--grasps",  "--compute", "--output",
                                  "--mu",     "--repair",  "--shells",  "--friction-angle",
                                  "--quiet",  "--torsion", "--scale",   "--replay"};
  options.replay_grasps = app.count("--replay") > 0;
  if (options.replay_by_hand) {
    throw InputError("--replay hand: requires a plan, expected --replay points with --grasps");
  }
  served.insert(of_replay.begin(), of_replay.end());
  RefuseOthers(app, served, "cannot be used with --grasps, requires a plan or a single grasp");
  for (const char* setting : {"--replay align", "--replay tip", "--replay feedback",
                              "--tolerance mm", "--tolerance deg"}) {
    if (options.settings.contains(setting)) {
      throw InputError(std::string(setting) + ": cannot be used with --grasps");
    }
  }
  if (options.replay.resisted_wrench) {
    throw InputError("--disturbance limits: cannot be used with --grasps");
  }
  if (options.replay_grasps) return;
  for (const std::string& name : of_replay) {
    if (app.count(name) > 0) {
      throw InputError(name + ": with --grasps requires --replay points");
    }
  }
}

void CheckForStates(const ValidateOptions& options, const CLI::App& app) {
  RefuseOthers(app,
               {"--object", "--hand", "--export-states", "--seed", "--jobs", "--output",
                "--export-mjcf", "--scale", "--friction-angle", "--mu", "--mass", "--density",
                "--grasp-force", "--clearance", "--tolerance", "--repair", "--shells", "--quiet"},
               "cannot be used with --export-states");
  if (options.states == 0) {
    throw InputError(
        "--export-states: the number of states is required, as in --export-states 100");
  }
  if (options.settings.contains("--tolerance diameters")) {
    throw InputError("--tolerance: with --export-states requires the unit mm or deg");
  }
  if (options.hand.empty()) throw InputError("--export-states: requires --hand");
  if (options.replay.hand_grasp_force) {
    throw InputError("--grasp-force realistic: cannot be used with --export-states");
  }
}

}  // namespace regrasp::apps
