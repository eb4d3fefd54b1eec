// evaluate: tests grasps of data sets on the hand that they were made for.

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "apps/converted_grasps.h"
#include "apps/evaluate_lines.h"
#include "apps/evaluate_reasons.h"
#include "apps/explain.h"
#include "apps/help.h"
#include "apps/list_option.h"
#include "apps/options.h"
#include "apps/program.h"
#include "planner/base/error.h"

namespace {

using namespace regrasp::apps;
using regrasp::sim::GraspProtocol;

constexpr int kMostProcesses = 1024;
constexpr NumberRange kFrictions = {.lower = 1e-3, .upper = 10};
constexpr NumberRange kMasses = {.lower = 1e-6, .upper = 1000};

/// Return the words of --protocol, which add a protocol once.
ListOption ProtocolOption(std::vector<GraspProtocol>& protocols) {
  ListOption option("--protocol");
  for (const GraspProtocol protocol : {GraspProtocol::kAnalytic, GraspProtocol::kDexGraspBench,
                                       GraspProtocol::kFall, GraspProtocol::kDisturbance}) {
    option.Word(std::string(regrasp::sim::GraspProtocolName(protocol)), [&protocols, protocol] {
      if (std::ranges::find(protocols, protocol) == protocols.end()) protocols.push_back(protocol);
    });
  }
  return option;
}

void AddEvaluateOptions(CLI::App& app, EvaluateOptions& options, std::string& palm) {
  BeginGroup(app, "Input");
  app.add_option("--grasps", options.grasps,
                 "Grasps by a whole hand: JSON Lines, or a file or folder of a data set, which "
                 "regrasp-convert converts first")
      ->type_name("FILE|FOLDER")
      ->required();
  app.add_option("--palm", palm,
                 "Pose of the palm frame in the body whose poses a data set has. Metres and unit "
                 "quaternion; --palm=-1,2,3 if it starts with a minus [default: identity]")
      ->type_name("X,Y,Z[,QW,QX,QY,QZ]");
  app.add_option("--hand", options.hand, "Hand file of the hand that the grasps were made for")
      ->type_name("FILE")
      ->required();
  app.add_option("--object", options.object,
                 "Folder of the object files, or the one object file of all grasps")
      ->type_name("FILE|FOLDER")
      ->required();
  BeginGroup(app, "Tests");
  ProtocolOption(options.protocols)
      .AddTo(app, "NAME,…",
             "Tests: analytic, dexgraspbench, fall, disturbance. A grasp passes if it passes all "
             "[default: analytic]");
  AddNumber(app, "--mu", options.test.mu, kFrictions,
            "Friction coefficient between hand and object [default: 0.6]");
  AddNumber(app, "--mass", options.test.mass_kg, kMasses, "Mass of the object [default: 0.1]",
            "KG");
  BeginGroup(app, "Output");
  app.add_option("-o,--output", options.outputs,
                 "Reports in JSON Lines, one per grasp. With the suffix .csv a table, with .npz "
                 "arrays for numpy.load, with .html a page with a table that can be sorted and "
                 "filtered. Repeat it for several files")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->required();
  app.add_option(
         "--images", options.images,
         "Folder of an image per grasp: hand, object and contacts. The page has links to them")
      ->type_name("FOLDER");
  app.add_option("--shard", options.shard, "Part I of N of the grasps. `merge` joins the results")
      ->type_name("I/N");
  AddInteger(app, "-j,--jobs", options.jobs, 1, kMostProcesses,
             "Number of parallel processes. Reports do not depend on it [default: one per "
             "processor]");
  app.add_flag("--restart", options.fresh, "Discard the results of an earlier run");
  MarkRare(app, {"--shard"});
  AddQuiet(app, options.quiet);
  AddExplain(app, {EvaluateReasons(), "evaluation of a hand grasp", "grasp_failure_reasons"});
  app.footer(
      "  evaluate --grasps grasps.jsonl --hand hand.json --object objects --output reports.jsonl\n"
      "  evaluate --grasps grasps.jsonl --hand hand.json --object objects --protocol "
      "fall,disturbance -o "
      "reports.jsonl -o reports.html\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(CommandText(kEvaluateName), kEvaluateName);
  EvaluateOptions options;
  options.jobs =
      std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostProcesses);
  std::string palm;
  AddEvaluateOptions(app, options, palm);
  return RunProgram(app, argc, argv, [&] {
    if (NeedsConversion(options.grasps)) {
      const std::string converted = std::filesystem::path(options.outputs.front())
                                        .replace_extension(".grasps.jsonl")
                                        .string();
      const int code =
          ConvertGrasps({options.grasps, options.hand, options.object, palm}, converted);
      if (code != 0) return code;
      options.grasps = converted;
    } else if (!palm.empty()) {
      throw regrasp::InputError("--palm cannot be used with " + options.grasps +
                                ", expected a file or folder of a data set");
    }
    if (options.protocols.empty()) options.protocols = {GraspProtocol::kAnalytic};
    return RunEvaluate(options);
  });
}
