#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regrasp {

/// Table that is written as Markdown and as CSV, with the same cells.
struct TableFile {
  std::string name;   ///< file name without ending
  std::string title;  ///< heading of the Markdown file
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Write `folder`/name.md and name.csv.
void WriteTable(const TableFile& table, const std::filesystem::path& folder);

}  // namespace regrasp
