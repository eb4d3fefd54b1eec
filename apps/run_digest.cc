#include "apps/run_digest.h"

#include <filesystem>
#include <system_error>

#include "apps/build_id.h"
#include "apps/program.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "report/json_values.h"
#include "sim/ode/ode_engine.h"
#include "sim/scene/mujoco_engine.h"

namespace regrasp::apps {

namespace {

Json FileJson(const report::FileDigest& file) {
  return {{"file", file.name}, {"sha256", file.sha256}};
}

}  // namespace

std::string ObjectPathOf(const ValidateOptions& options, const std::string& named_by_plan) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_directory(options.object_path, error)) return options.object_path;
  // Only the name counts: a plan must not lead out of the folder.
  const fs::path name = fs::path(named_by_plan).filename();
  const fs::path path = options.object_path / name;
  if (!name.empty() && fs::is_regular_file(path, error)) return path.string();
  throw InputError(options.plan_path + ": /object/file: there is no file \"" + name.string() +
                   "\" in " + options.object_path);
}

std::string CommandText(const ValidateOptions& options, const RunInputs& inputs) {
  std::string text = std::string(kValidateName) + " --object " + inputs.object.name +
                     (options.for_grasp() ? " --grasp " : " --plan ") + inputs.input.name;
  // Their names change no result.
  if (!options.start.empty()) text += " --start …";
  if (!options.goal.empty()) text += " --goal …";
  if (!options.hand.empty()) text += " --hand …";
  for (const auto& [name, values] : options.given) {
    text += " " + name;
    // A flag has a value too, which nobody types.
    for (const std::string& value : values) {
      if (!value.empty() && value != "true") text += " " + value;
    }
  }
  return text;
}

std::string RunDigest(const ValidateOptions& options, const RunInputs& inputs) {
  const Json json = {{"version", ProgramVersion()},
                     {"build", BuildId()},
                     {"engine", sim::EngineVersion()},
                     {"second_engine", sim::OdeVersion()},
                     {"input", FileJson(inputs.input)},
                     {"object", FileJson(inputs.object)},
                     {"start", report::TextOrNull(inputs.start_sha256)},
                     {"goal", report::TextOrNull(inputs.goal_sha256)},
                     {"hand", report::TextOrNull(inputs.hand_sha256)},
                     {"options", options.given}};
  // File names and values may be any bytes.
  return Sha256(json.dump(-1, ' ', /*ensure_ascii=*/true, Json::error_handler_t::replace));
}

}  // namespace regrasp::apps
