#pragma once

#include <string>
#include <string_view>

#include "apps/evaluate_rows.h"

namespace regrasp::apps {

/// Format a text as a cell of CSV (RFC 4180).
/// A text that spreadsheets would execute as a formula gets a leading apostrophe.
[[nodiscard]] std::string CsvCell(std::string_view text);

/// Return the header line of the table of grasps, with its line end.
[[nodiscard]] std::string GraspCsvHeader();

/// Return the line of a grasp, with its line end. Values that are missing are empty cells.
/// @param file  name of the file of the grasps.
[[nodiscard]] std::string GraspCsvLine(const GraspRow& row, std::string_view file);

}  // namespace regrasp::apps
