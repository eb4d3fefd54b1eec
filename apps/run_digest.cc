#include "apps/run_digest.h"

#include <filesystem>
#include <system_error>

#include "apps/build_id.h"
#include "apps/program.h"
#include "apps/repair_module.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/kinematics/hand_file.h"
#include "sim/ode/ode_engine.h"
#include "sim/scene/mujoco_engine.h"

namespace regrasp::apps {

std::string ObjectPathOf(const ValidateOptions& options, const std::string& named_by_plan) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_directory(options.object_path, error)) return options.object_path;
  // Only the file name is used: a plan must not refer to files outside the folder.
  const fs::path name = fs::path(named_by_plan).filename();
  const fs::path path = options.object_path / name;
  if (!name.empty() && fs::is_regular_file(path, error)) return path.string();
  throw InputError(options.plan_path + ": /object/file: \"" + name.string() + "\" not found in " +
                   options.object_path);
}

std::string CommandText(const ValidateOptions& options, const RunInputs& inputs) {
  std::string text = std::string(kValidateName) + " --object " + inputs.object.name +
                     (options.for_grasp() ? " --grasp " : " --plan ") + inputs.input.name;
  // The names of these files change no result.
  if (!options.start.empty()) text += " --start …";
  if (!options.goal.empty()) text += " --goal …";
  if (!options.hand.empty()) text += " --hand …";
  for (const auto& [name, values] : options.given) {
    text += " " + name;
    // CLI11 gives a flag the value "true", which users do not type.
    for (const std::string& value : values) {
      if (!value.empty() && value != "true") text += " " + value;
    }
  }
  return text;
}

std::string RepairInput(const ValidateOptions& options, const std::string& plan_text) {
  // The search may find the word in a plan without a repair. The digest then includes one input
  // more than required.
  const bool repaired = plan_text.find("\"repair\"") != std::string::npos;
  return options.repair.wanted() || repaired ? RepairModuleDigest() : "";
}

std::string HandInput(const ValidateOptions& options) {
  if (options.hand.empty()) return "";
  if (!options.hand_sha256.empty()) return options.hand_sha256;
  return kinematics::ReadHand(options.hand).sha256;
}

InputsDigest BuildDigest() {
  InputsDigest digest;
  digest.Add("version", ProgramVersion()).Add("build", BuildId());
  digest.Add("engine", sim::EngineVersion()).Add("second_engine", sim::OdeVersion());
  return digest;
}

std::string RunDigest(const ValidateOptions& options, const RunInputs& inputs) {
  InputsDigest digest = BuildDigest();
  digest.Add("input", inputs.input.name).Add("sha256", inputs.input.sha256);
  digest.Add("object", inputs.object.name).Add("sha256", inputs.object.sha256);
  for (const auto& [name, sha256] : {std::pair("start", &inputs.start_sha256),
                                     {"goal", &inputs.goal_sha256},
                                     {"hand", &inputs.hand_sha256},
                                     {"repair", &inputs.repair_sha256}}) {
    sha256->empty() ? digest.AddAbsent(name) : digest.Add(name, *sha256);
  }
  if (!options.conditions_sha256.empty()) digest.Add("conditions", options.conditions_sha256);
  return digest.Add("options", options.given).Finish();
}

}  // namespace regrasp::apps
