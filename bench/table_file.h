#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regrasp {

/// A table for people and programs: the same cells as Markdown and as CSV.
struct TableFile {
  std::string name;   ///< of the files, without ending
  std::string title;  ///< heads the Markdown
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Writes `folder`/name.md and name.csv.
void WriteTable(const TableFile& table, const std::filesystem::path& folder);

}  // namespace regrasp
