#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regrasp::apps {

struct LibraryPlan {
  std::string name;  ///< file name without .json, which is the name of the folder of its results
  std::filesystem::path path;
};

struct SkippedFile {
  std::string file;  ///< file name
  std::string why;   ///< reason: "is a regrasp-grasp file"
};

/// Files next to the folders of the plans: the summary of a batch, and its overview page.
inline constexpr char kSummaryName[] = "summary.json";
inline constexpr char kIndexName[] = "index.html";

/// Plans of a batch.
struct PlanLibrary {
  std::vector<LibraryPlan> plans;
  std::vector<SkippedFile> skipped;  ///< skipped files of folders
};

/// Return the plans in the given files and folders.
/// For a folder these are all *.json files sorted by name, except those that identify themselves as
/// another format. A file that cannot be parsed is included: it may be a damaged plan.
/// @throws InputError  if a folder has no plan, if two plans have the same name and would write
///     into the same folder, or if a name cannot be that of a folder.
[[nodiscard]] PlanLibrary FindPlans(const std::vector<std::string>& paths);

/// Maximum size of a file whose format is checked here, bytes. A larger file is included as a plan;
/// its own validation may then reject it.
inline constexpr std::size_t kMaxPlanFileBytes = std::size_t{1} << 24;

}  // namespace regrasp::apps
