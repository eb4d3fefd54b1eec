#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regrasp::bench {

/// Records of a CSV file (RFC 4180): comma-separated cells, quoted if they contain commas. The
/// first line names the columns. Lines that are empty or begin with # are skipped.
class CsvTable {
 public:
  /// @param name  name in messages, usually the file's path.
  /// @throws InputError  if a line has a different number of cells than the first, or a quotation
  ///     is not closed.
  static CsvTable Parse(std::string_view text, const std::string& name);

  [[nodiscard]] int size() const { return static_cast<int>(records_.size()); }
  /// Return a cell. @throws InputError  if there is no such column.
  [[nodiscard]] const std::string& At(int record, const std::string& column) const;
  /// Return the position for messages: "tasks.csv: line 7".
  [[nodiscard]] std::string Place(int record) const;

 private:
  std::string name_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> records_;
  std::vector<int> lines_;  ///< line number of each record, from 1
};

/// Parse `count` numbers separated by spaces or commas.
/// @param place  position of the text, for messages.
/// @throws InputError  if the text contains anything different.
[[nodiscard]] std::vector<double> ParseNumbers(const std::string& text, int count,
                                               const std::string& place);

}  // namespace regrasp::bench
