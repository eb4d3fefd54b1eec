#include "apps/validate_modes.h"

#include <set>
#include <string>

#include "planner/base/error.h"

namespace regrasp::apps {
namespace {

/// @param why  after the name of an option that is given and not served.
void RefuseOthers(const CLI::App& app, const std::set<std::string>& served,
                  const std::string& why) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && !served.contains(name)) throw InputError(name + " " + why);
  }
}

/// Longer than any plan takes, and still a number of seconds that clocks can add.
constexpr double kLongestTime_s = 1e6;

}  // namespace

void AddBatch(CLI::App& app, ValidateOptions& options) {
  app.add_option("--shard", options.shard,
                 "Part I of N of the plans in a file of lines alone; merge joins the results")
      ->type_name("I/N");
  AddInteger(app, "--jobs", options.jobs, 1, kMostJobs,
             "How many of several plans are validated at a time; of --export-states, threads "
             "(default: one a processor)");
  AddNumber(app, "--time-limit", options.time_limit_s,
            {.lower = 0, .upper = kLongestTime_s, .lower_included = false},
            "Longest time that one of several plans may take, seconds; it is then stopped and "
            "counts as an error (default: none)",
            "S");
  app.add_flag(
      "--fresh", options.fresh,
      "Validate all of several plans anew; of a file of lines throw away what an earlier run left; "
      "otherwise a plan keeps the results of an earlier "
      "run where plan, object, options and the program's build are the same and no result was "
      "edited");
}

void AddStates(CLI::App& app, ValidateOptions& options) {
  // Of a million the file has some 700 MB.
  constexpr int kMostStates = 1'000'000;
  CLI::Option* states = AddInteger(
      app, "--export-states", options.states, 1, kMostStates,
      "Make so many states in which a hand holds the object, instead of a plan; for those who "
      "train policies. Random grasps anywhere in the hand: it takes hold, and the state that it "
      "comes to is held for a second in MuJoCo from what is stored, velocities zero, all controls "
      "as they are. What is not held is counted, and not written. In states.npz are joints (N, J), "
      "rad; controls (N, A); object_position (N, 3), m, and object_quaternion (N, 4), w x y z, in "
      "the palm's frame; holds (N, F), which fingers do; and what else docs/formats.md describes. "
      "--export-mjcf writes the scene that they are for");
  AddNumber(app, "--min-quality", options.min_quality, {0, 1},
            "Quality that grasps of --export-states have at least (default 0.01)")
      ->needs(states);
}

void CheckForGrasps(ValidateOptions& options, const CLI::App& app) {
  const std::set<std::string> of_replay = {"--mass",          "--density",   "--thickness",
                                           "--finger-radius", "--squeeze",   "--shake",
                                           "--protocol",      "--tolerance", "--engine"};
  std::set<std::string> served = {
      "--object",         "--grasps",   "--required-angle", "--quality", "--out",
      "--friction-angle", "--mu",       "--max-deviation",  "--faces",   "--part",
      "--repair",         "--solidify", "--shells",         "--quiet",   "--scale",
      "--replay",         "--contact",  "--torsion"};
  options.replay_grasps = app.count("--replay") > 0;
  if (options.replay_by_hand) {
    throw InputError("--replay hand: goes with a plan; grasps are replayed by points");
  }
  served.insert(of_replay.begin(), of_replay.end());
  RefuseOthers(app, served, "goes with a plan or a single grasp, not with --grasps");
  if (options.replay_grasps) return;
  for (const std::string& name : of_replay) {
    if (app.count(name) > 0) throw InputError(name + " goes with --replay points, of --grasps");
  }
}

void CheckForStates(const ValidateOptions& options, const CLI::App& app) {
  RefuseOthers(
      app,
      {"--object",       "--hand",          "--export-states", "--min-quality", "--seed",
       "--jobs",         "--out",           "--export-mjcf",   "--scale",       "--friction-angle",
       "--mu",           "--mass",          "--density",       "--squeeze",     "--clearance",
       "--tolerance-mm", "--tolerance-deg", "--max-deviation", "--faces",       "--part",
       "--repair",       "--solidify",      "--shells",        "--quiet"},
      "does not go with --export-states");
  if (options.hand.empty()) throw InputError("--export-states: needs a hand (--hand)");
  if (options.replay.hand_squeeze) {
    throw InputError("--squeeze realistic: goes with ideal fingers; with --export-states newtons");
  }
}

}  // namespace regrasp::apps
