#include "apps/evaluate_files.h"

#include <filesystem>
#include <iostream>
#include <system_error>

#include "apps/batch/line_output.h"
#include "apps/evaluate_csv.h"
#include "apps/evaluate_page.h"
#include "apps/evaluate_table.h"
#include "apps/output_files.h"
#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp::apps {

namespace {

void SetOutput(const std::string& file, const char* format, std::string& place) {
  if (!place.empty()) {
    throw InputError("--output: expected one " + std::string(format) + " file, found " + place +
                     " and " + file);
  }
  place = file;
}

/// Write the CSV file. All of it is in memory, because WriteFile replaces files at once.
void WriteTable(const EvaluateFiles& files, const std::string& grasps) {
  std::string text = GraspCsvHeader();
  ReadGraspRows(files.reports, [&](const GraspRow& row) { text += GraspCsvLine(row, grasps); });
  WriteFile(files.table, text);
}

}  // namespace

EvaluateFiles SortEvaluateOutputs(const EvaluateOptions& options) {
  EvaluateFiles files;
  for (const std::string& file : options.outputs) {
    if (LowerSuffix(file) == ".csv") {
      SetOutput(file, "CSV", files.table);
    } else if (IsHtmlFile(file)) {
      SetOutput(file, "HTML", files.page);
    } else {
      SetOutput(file, "JSON Lines", files.reports);
    }
  }
  if (!files.reports.empty()) return files;
  if (!options.shard.empty()) {
    throw InputError("--shard requires an output in JSON Lines, found " + options.outputs.front());
  }
  files.keeps_reports = false;
  files.reports = (files.page.empty() ? files.table : files.page) + kPartEnding;
  return files;
}

void WriteEvaluateFiles(const EvaluateFiles& files, const EvaluateOptions& options) {
  const std::string grasps = std::filesystem::path(options.grasps).filename().string();
  if (!files.table.empty()) WriteTable(files, grasps);
  if (!files.page.empty()) {
    const std::filesystem::path folder = std::filesystem::absolute(files.page).parent_path();
    const std::string images =
        options.images.empty()
            ? ""
            : std::filesystem::absolute(options.images).lexically_relative(folder).string();
    WriteFile(files.page, FormatGraspPage(files.reports, {.grasps = grasps, .images = images}));
  }
  if (!options.quiet) std::cout << FormatEvaluateTable(ReadEvaluateCounts(files.reports));
  std::error_code error;
  if (!files.keeps_reports) std::filesystem::remove(files.reports, error);
}

}  // namespace regrasp::apps
