#include "bench/table_file.h"

#include "planner/base/file.h"

namespace regrasp {

namespace {

std::string Line(const std::vector<std::string>& cells, const std::string& before,
                 const std::string& between, const std::string& after) {
  std::string line = before;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : between) + cells[i];
  return line + after + "\n";
}

}  // namespace

void WriteTable(const TableFile& table, const std::filesystem::path& folder) {
  const auto row = [](const std::vector<std::string>& cells) {
    return Line(cells, "| ", " | ", " |");
  };
  std::string markdown = "# " + table.title + "\n\n" + row(table.columns) +
                         row(std::vector<std::string>(table.columns.size(), "---"));
  std::string csv = Line(table.columns, "", ",", "");
  for (const std::vector<std::string>& cells : table.rows) {
    markdown += row(cells);
    csv += Line(cells, "", ",", "");
  }
  WriteFile(folder / (table.name + ".md"), markdown);
  WriteFile(folder / (table.name + ".csv"), csv);
}

}  // namespace regrasp
