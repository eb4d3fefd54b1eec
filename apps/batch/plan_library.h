#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regrasp::apps {

struct LibraryPlan {
  std::string name;  ///< the file's, without .json: the folder of its results
  std::filesystem::path path;
};

struct SkippedFile {
  std::string file;  ///< its name
  std::string why;   ///< "is a regrasp-grasp file"
};

/// Files beside the folders of the plans: the summary of a batch, and its page.
inline constexpr char kSummaryName[] = "summary.json";
inline constexpr char kIndexName[] = "index.html";

/// The plans that a batch goes through.
struct PlanLibrary {
  std::vector<LibraryPlan> plans;
  std::vector<SkippedFile> skipped;  ///< of folders
};

/// Files as they are named, and of a folder every *.json, by name, that does not say itself that it
/// is something else: a file that cannot be parsed may have been a plan.
/// @throws InputError  no plan in a folder; two plans of one name, which would write into the same
///                     folder; a name that cannot be one of a folder.
[[nodiscard]] PlanLibrary FindPlans(const std::vector<std::string>& paths);

/// A file larger than this is taken for a plan without looking; its own run may then refuse it.
inline constexpr std::size_t kMostLookedAtBytes = std::size_t{1} << 24;

}  // namespace regrasp::apps
