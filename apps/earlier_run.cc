#include "apps/earlier_run.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "apps/batch/report_summary.h"
#include "apps/frame_files.h"
#include "apps/run_digest.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/plan/plan_io.h"

namespace regrasp {

namespace {

namespace fs = std::filesystem;

std::string DigestOfNow(const ValidateOptions& options) {
  const std::string plan = ReadFile(options.plan_path);
  std::error_code error;
  const bool named_by_plan = fs::is_directory(options.object_path, error);
  const std::string object_path =
      ObjectPathOf(options, named_by_plan ? ParsePlan(plan, options.plan_path).object_file : "");
  return RunDigest(options, {fs::path(options.plan_path).filename().string(), Sha256(plan)},
                   {fs::path(object_path).filename().string(), Sha256(ReadFile(object_path))});
}

bool IsComplete(const fs::path& folder, const ReportSummary& report, bool animated) {
  std::vector<std::string> files = {kPageName};
  for (const ReportSummary::Entry& entry : report.entries) {
    if (!entry.frame.empty()) files.push_back(entry.frame);
  }
  const bool replayed = files.size() > 1;
  if (replayed) files.emplace_back(kOverviewName);
  if (replayed && animated) files.emplace_back(kAnimationName);
  return std::ranges::all_of(files, [&](const std::string& file) {
    std::error_code error;
    return fs::is_regular_file(folder / file, error);
  });
}

bool IsResultName(const std::string& name) {
  return name == kReportName || name == kPageName || IsPictureName(name);
}

}  // namespace

bool HasSameRun(const ValidateOptions& options) {
  const fs::path folder = options.Folder();
  std::error_code error;
  if (!fs::is_regular_file(folder / kReportName, error)) return false;
  try {
    const ReportSummary report = ReadReportSummary(folder / kReportName);
    return IsComplete(folder, report, options.animate) && report.run == DigestOfNow(options);
  } catch (const InputError&) {
    return false;  // the run itself says what is wrong
  }
}

void RemoveEarlierRun(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (IsResultName(name) || IsResultName(NameBesideAside(name))) files.push_back(entry->path());
  }
  if (error == std::errc::no_such_file_or_directory) return;
  // The report first: it never stands beside half of its pictures.
  std::ranges::partition(files,
                         [](const fs::path& file) { return file.filename() == kReportName; });
  for (const fs::path& file : files) {
    if (!error) fs::remove(file, error);
  }
  if (error) throw EnvironmentError(folder.string() + ": " + error.message());
}

}  // namespace regrasp
