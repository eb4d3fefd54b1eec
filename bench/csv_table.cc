#include "bench/csv_table.h"

#include <algorithm>
#include <sstream>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::bench {
namespace {

std::vector<std::string> Cells(std::string_view line, const std::string& place) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && line.substr(i + 1).starts_with('"')) {
      cells.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted) throw InputError(place + ": a quotation mark has no end on its line");
  return cells;
}

}  // namespace

CsvTable CsvTable::Parse(std::string_view text, const std::string& name) {
  CsvTable table;
  table.name_ = name;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.starts_with('#')) continue;
    const std::string place = name + ": line " + std::to_string(number);
    std::vector<std::string> cells = Cells(line, place);
    if (table.columns_.empty()) {
      table.columns_ = std::move(cells);
      continue;
    }
    if (cells.size() != table.columns_.size()) {
      throw InputError(place + ": " + std::to_string(cells.size()) + " cells, but there are " +
                       std::to_string(table.columns_.size()) + " columns");
    }
    table.records_.push_back(std::move(cells));
    table.lines_.push_back(number);
  }
  return table;
}

const std::string& CsvTable::At(int record, const std::string& column) const {
  const auto found = std::ranges::find(columns_, column);
  if (found == columns_.end()) throw InputError(name_ + ": there is no column \"" + column + "\"");
  return records_[record][found - columns_.begin()];
}

std::string CsvTable::Place(int record) const {
  return name_ + ": line " + std::to_string(lines_[record]);
}

std::vector<double> ParseNumbers(const std::string& text, int count, const std::string& place) {
  std::string spaced = text;
  std::ranges::replace(spaced, ',', ' ');
  std::istringstream words(spaced);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    const auto number = ParseDouble(word);
    if (!number) throw InputError(place + ": expected a number, found \"" + word + "\"");
    numbers.push_back(*number);
  }
  if (static_cast<int>(numbers.size()) != count) {
    throw InputError(place + ": expected " + std::to_string(count) + " numbers, found \"" + text +
                     "\"");
  }
  return numbers;
}

}  // namespace regrasp::bench
