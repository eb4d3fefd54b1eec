#include "apps/evaluate_files.h"

#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/batch/line_output.h"
#include "apps/evaluate_csv.h"
#include "apps/evaluate_npz.h"
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

/// Write the NPZ file.
void WriteArrays(const EvaluateFiles& files) {
  std::vector<GraspRow> rows;
  ReadGraspRows(files.reports, [&](GraspRow row) { rows.push_back(std::move(row)); });
  std::string bytes;
  try {
    bytes = FormatGraspNpz(rows);
  } catch (const std::length_error&) {
    throw InputError("--output: " + files.arrays + ": " + std::to_string(rows.size()) +
                     " grasps are too many for an NPZ file, expected at most 2 GB");
  }
  WriteFile(files.arrays, bytes);
}

}  // namespace

EvaluateFiles SortEvaluateOutputs(const EvaluateOptions& options) {
  EvaluateFiles files;
  for (const std::string& file : options.outputs) {
    if (LowerSuffix(file) == ".csv") {
      SetOutput(file, "CSV", files.table);
    } else if (LowerSuffix(file) == ".npz") {
      SetOutput(file, "NPZ", files.arrays);
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
  const std::string& table = files.table.empty() ? files.arrays : files.table;
  files.reports = (files.page.empty() ? table : files.page) + kPartEnding;
  return files;
}

void WriteEvaluateFiles(const EvaluateFiles& files, const EvaluateOptions& options) {
  const std::string grasps = std::filesystem::path(options.grasps).filename().string();
  if (!files.table.empty()) WriteTable(files, grasps);
  if (!files.arrays.empty()) WriteArrays(files);
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
