#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regrasp::bench {

/// Records of a CSV file (RFC 4180): cells between commas, in quotation marks where they have
/// commas. Its first line names the columns; lines that are empty or begin with # are skipped.
class CsvTable {
 public:
  /// @param name  how messages call it, usually the file's path.
  /// @throws InputError  a line has another number of cells than the first one, or a quotation mark
  ///                     has no end.
  static CsvTable Parse(std::string_view text, const std::string& name);

  [[nodiscard]] int size() const { return static_cast<int>(records_.size()); }
  /// A cell. @throws InputError  there is no such column.
  [[nodiscard]] const std::string& At(int record, const std::string& column) const;
  /// "tasks.csv: line 7", for messages.
  [[nodiscard]] std::string Place(int record) const;

 private:
  std::string name_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> records_;
  std::vector<int> lines_;  ///< of each record, from 1
};

/// So many numbers between spaces or commas.
/// @param place  where they stand, for messages.
/// @throws InputError  there are others.
[[nodiscard]] std::vector<double> ParseNumbers(const std::string& text, int count,
                                               const std::string& place);

}  // namespace regrasp::bench
