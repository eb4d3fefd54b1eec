#include "apps/evaluate_csv.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

/// First characters of formulas in spreadsheets.
constexpr std::string_view kFormula = "=+-@\t\r\n";

std::string NumberCell(const std::optional<double>& value) {
  return value ? FormatDouble(*value) : "";
}

std::string JoinedLine(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (&cell == cells.data() ? "" : ",") + cell;
  return line + "\n";
}

}  // namespace

std::string CsvCell(std::string_view text) {
  std::string cell(text);
  if (!cell.empty() && kFormula.find(cell.front()) != std::string_view::npos)
    cell.insert(0, 1, '\'');
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string GraspCsvHeader() {
  std::vector<std::string> names = {"file",        "index",          "id",      "set",
                                    "object",      "scale",          "hand",    "verdict",
                                    "claimed",     "score",          "reason",  "likely_cause",
                                    "distance_mm", "penetration_mm", "contacts"};
  for (const std::string_view protocol : kProtocolNames) {
    names.emplace_back(protocol);
    names.push_back(std::string(protocol) + "_reason");
  }
  for (const char* name : {"quality", "moved_mm", "rotated_deg", "held_s", "resisted_N"}) {
    names.emplace_back(name);
  }
  return JoinedLine(names);
}

std::string GraspCsvLine(const GraspRow& row, std::string_view file) {
  std::vector<std::string> cells = {CsvCell(file),
                                    std::to_string(row.index),
                                    CsvCell(row.id),
                                    CsvCell(row.set),
                                    CsvCell(row.object),
                                    NumberCell(row.scale),
                                    CsvCell(row.hand),
                                    row.verdict,
                                    row.claimed ? (*row.claimed ? "true" : "false") : "",
                                    NumberCell(row.score),
                                    CsvCell(row.reason),
                                    CsvCell(row.likely_cause),
                                    NumberCell(row.distance_mm),
                                    NumberCell(row.depth_mm()),
                                    CsvCell(row.contacts())};
  const auto& [analytic, bench, fall, disturbance] = row.results;
  for (const ProtocolCell& result : row.results) {
    cells.push_back(result.verdict);
    cells.push_back(CsvCell(result.reason));
  }
  for (const auto& value : {analytic.quality, bench.moved_mm, bench.rotated_deg, fall.seconds,
                            disturbance.resisted_N}) {
    cells.push_back(NumberCell(value));
  }
  return JoinedLine(cells);
}

}  // namespace regrasp::apps
