#include "apps/earlier_run.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/batch/plan_library.h"
#include "apps/batch/report_summary.h"
#include "apps/frame_files.h"
#include "apps/program.h"
#include "apps/repair_module.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/plan_io.h"
#include "report/report_json.h"
#include "sim/ode/ode_engine.h"
#include "sim/scene/mujoco_engine.h"

namespace regrasp::apps {

namespace {

namespace fs = std::filesystem;

std::string DigestOfNow(const ValidateOptions& options) {
  const std::string plan = ReadFile(options.plan_path);
  std::error_code error;
  const bool named_by_plan = fs::is_directory(options.object_path, error);
  const std::string object_path = ObjectPathOf(
      options, named_by_plan ? plan::ParsePlan(plan, options.plan_path).object_file : "");
  const auto digest_of = [](const std::string& path) {
    return path.empty() ? "" : Sha256(ReadFile(path));
  };
  return RunDigest(options,
                   {{fs::path(options.plan_path).filename().string(), Sha256(plan)},
                    {fs::path(object_path).filename().string(), Sha256(ReadFile(object_path))},
                    digest_of(options.start),
                    digest_of(options.goal),
                    HandInput(options),
                    RepairInput(options, plan)});
}

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// Return the text of a file; empty if it cannot be read.
std::string TextOf(const fs::path& path) {
  if (!IsFile(path)) return "";
  try {
    return ReadFile(path);
  } catch (const InputError&) {
    return "";
  }
}

/// Return whether the files in a report's folder have the digests in the report.
bool AreUnchanged(const fs::path& folder, const std::vector<report::FileDigest>& files) {
  return std::ranges::all_of(files, [&](const report::FileDigest& file) {
    const fs::path path = folder / file.name;
    return IsFile(path) && Sha256(ReadFile(path)) == file.sha256;
  });
}

bool Holds(std::string_view text, const std::string& word) {
  return text.find('"' + word + '"') != std::string_view::npos;
}

/// Return the names of the results that a report lists.
/// The report may be cut or edited such that it is not valid JSON. The files that it names are
/// removed anyway.
std::vector<std::string> NamesIn(const std::string& report) {
  const std::size_t begin = report.find("\"files\"");
  if (begin == std::string::npos) return {};
  std::vector<std::string> names;
  std::istringstream list(report.substr(begin, report.find(']', begin) - begin));
  for (std::string piece; std::getline(list, piece, '"');) {
    if (IsValidationFile(piece)) names.push_back(piece);
  }
  return names;
}

}  // namespace

bool HasSameRun(const ValidateOptions& options) {
  const fs::path folder = options.Folder();
  std::error_code error;
  const bool finished =
      fs::symlink_status(folder / kRunFileName, error).type() == fs::file_type::not_found;
  if (!finished || !IsFile(folder / kReportName)) return false;
  try {
    const std::string text = ReadFile(folder / kReportName);
    if (!report::IsSealed(text)) return false;
    const ReportSummary report = SummarizeReport(ParseJson(text, kReportName), kReportName);
    return AreUnchanged(folder, report.files) && report.run == DigestOfNow(options);
  } catch (const InputError&) {
    return false;  // the run itself reports the error
  }
}

std::set<std::string> OwnResults(const LockedOutputFolder& folder) {
  std::set<std::string> own;
  for (const std::string& name : folder.left_behind()) {
    if (IsValidationFile(name)) own.insert(name);
  }
  const std::string report = TextOf(folder.path() / kReportName);
  if (!Holds(report, "regrasp-report") || !Holds(report, "run")) return own;
  own.insert(kReportName);
  for (const std::string& name : NamesIn(report)) own.insert(name);
  return own;
}

std::set<std::string> OwnSummary(const LockedOutputFolder& folder) {
  std::set<std::string> own;
  for (const char* name : {kSummaryName, kIndexName}) {
    if (folder.left_behind().contains(name)) own.insert(name);
  }
  const std::string summary = TextOf(folder.path() / kSummaryName);
  if (!Holds(summary, "regrasp-summary")) return own;
  own.insert(kSummaryName);
  if (Holds(summary, kIndexName)) own.insert(kIndexName);
  return own;
}

void ExpectFree(const LockedOutputFolder& folder, const std::set<std::string>& own,
                const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const fs::path path = folder.path() / name;
    std::error_code error;
    const fs::file_type there = fs::symlink_status(path, error).type();
    if (there == fs::file_type::not_found) continue;
    if (there != fs::file_type::directory && own.contains(name)) continue;
    throw InputError(
        path.string() +
        ": cannot overwrite a file that no earlier run wrote; help: move it or pass another "
        "--output");
  }
}

void RemoveEarlierRun(LockedOutputFolder& folder, const std::set<std::string>& own) {
  if (own.empty()) return;
  folder.Announce({own.begin(), own.end()});
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder.path(), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool ours = own.contains(name) || own.contains(NameBesideAside(name));
    if (ours && !entry->is_directory(error)) files.push_back(entry->path());
  }
  // Remove the report first, so that it never exists without a part of its images.
  std::ranges::partition(files,
                         [](const fs::path& file) { return file.filename() == kReportName; });
  for (const fs::path& file : files) {
    if (!error) fs::remove(file, error);
  }
  if (error) throw EnvironmentError(folder.path().string() + ": " + error.message());
}

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
  // The HTML report links to the index page of its batch.
  if (!options.index_key.empty()) digest.Add("index", options.index_key);
  return digest.Add("options", options.given).Finish();
}

}  // namespace regrasp::apps
