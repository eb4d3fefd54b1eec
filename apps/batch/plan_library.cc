#include "apps/batch/plan_library.h"

#include <algorithm>
#include <map>
#include <system_error>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"

namespace regrasp::apps {

namespace {

namespace fs = std::filesystem;

constexpr char kSuffix[] = ".json";
constexpr char kPlanFormat[] = "regrasp-plan";

/// Return the reason why a file is not a plan; empty if it may be one.
std::string WhyNoPlan(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return "is a folder";
  // A missing file may have been a plan.
  if (!fs::exists(path, error)) return "";
  // A pipe or a device may have no end.
  if (!fs::is_regular_file(path, error)) return "is not a regular file";
  if (fs::file_size(path, error) > kMaxPlanFileBytes) return "";
  try {
    const Json json = ParseJson(ReadFile(path), path.string());
    const auto format = json.find("format");
    if (!json.is_object() || format == json.end() || !format->is_string()) {
      return "format not found";
    }
    if (*format == kPlanFormat) return "";
    return "is a " + format->get<std::string>().substr(0, sizeof "regrasp-12345678") + " file";
  } catch (const InputError&) {
    return "";
  }
}

/// Maximum number of counted files below a folder; sufficient for a message.
constexpr int kMostBelow = 1000;

bool IsPlan(const fs::path& path) {
  std::error_code error;
  if (path.extension() != kSuffix || !fs::is_regular_file(path, error)) return false;
  if (fs::file_size(path, error) > kMaxPlanFileBytes) return true;
  try {
    const Json json = ParseJson(ReadFile(path), path.string());
    return json.is_object() && json.value("format", Json()) == kPlanFormat;
  } catch (const InputError&) {
    return false;
  }
}

int CountPlansBelow(const fs::path& folder) {
  int files = 0, plans = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end;
       !error && entry != end && files < kMostBelow; entry.increment(error)) {
    ++files;
    if (IsPlan(entry->path())) ++plans;
  }
  return plans;
}

std::string CountText(int plans) {
  return std::to_string(plans) + (plans == 1 ? " plan" : " plans");
}

/// Record the subfolders, with the number of files in each, as skipped: they are not searched.
void SkipSubfolders(const fs::path& folder, PlanLibrary& library) {
  std::vector<fs::path> subfolders;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool own = entry->is_directory(error) && !entry->is_symlink(error);
    if (own && entry->path().extension() != kSuffix) subfolders.push_back(entry->path());
  }
  std::ranges::sort(subfolders);
  for (const fs::path& subfolder : subfolders) {
    const int plans = CountPlansBelow(subfolder);
    if (plans == 0) continue;
    library.skipped.push_back(
        {subfolder.filename().string() + "/",
         "is a subfolder with " + CountText(plans) + "; subfolders are not searched"});
  }
}

/// Return the message that a folder has no plan, with hints on where plans are.
std::string NoPlanText(const fs::path& folder) {
  PlanLibrary below;
  SkipSubfolders(folder, below);
  std::string text =
      folder.string() + ": no plan found, expected *.json files with the format " + kPlanFormat;
  for (const SkippedFile& file : below.skipped) text += "; " + file.file + " " + file.why;
  std::error_code error;
  if (!below.skipped.empty()) {
    text += "; help: give --plan " + (folder / fs::path(below.skipped.front().file)).string();
  } else {
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      if (entry->path().extension() != ".jsonl") continue;
      return text + "; help: give --plan " + entry->path().string();
    }
  }
  return text;
}

void AddFolder(const fs::path& folder, PlanLibrary& library) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == kSuffix) files.push_back(entry->path());
  }
  if (error) throw InputError(folder.string() + ": cannot be read: " + error.message());
  std::ranges::sort(files);
  const std::size_t before = library.plans.size();
  for (const fs::path& file : files) {
    const std::string why = WhyNoPlan(file);
    if (why.empty()) {
      library.plans.push_back({file.stem().string(), file});
    } else {
      library.skipped.push_back({file.filename().string(), why});
    }
  }
  if (library.plans.size() == before) throw InputError(NoPlanText(folder));
  SkipSubfolders(folder, library);
}

void CheckNames(const PlanLibrary& library) {
  std::map<std::string, fs::path> seen;
  for (const LibraryPlan& plan : library.plans) {
    // These names are reserved for files next to the folders.
    const bool taken =
        plan.name == kSummaryName || plan.name == kIndexName || plan.name == ".regrasp-run";
    if (plan.name.empty() || plan.name == "." || plan.name == ".." || taken) {
      throw InputError(plan.path.string() + ": the name of a plan must be usable as a folder name");
    }
    const auto [other, fresh] = seen.emplace(plan.name, plan.path);
    if (fresh) continue;
    throw InputError("--plan: " + other->second.string() + " and " + plan.path.string() +
                     " must have different names, found \"" + plan.name + "\" twice");
  }
}

}  // namespace

PlanLibrary FindPlans(const std::vector<std::string>& paths) {
  PlanLibrary library;
  for (const std::string& path : paths) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
      AddFolder(path, library);
    } else {
      library.plans.push_back({fs::path(path).stem().string(), path});
    }
  }
  CheckNames(library);
  return library;
}

}  // namespace regrasp::apps
