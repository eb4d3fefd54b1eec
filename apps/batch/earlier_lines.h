#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace regrasp::apps {

/// The entries in a file of lines that an earlier run left, read once as a stream.
///
/// The file may be anything: missing, cut, edited, of other entries. Lines that are not whole or do
/// not begin as those of an entry are skipped, and entries that do not ascend. Lines without a seal
/// (SealRecord) may be skipped.
class EarlierLines {
 public:
  /// No entries.
  EarlierLines() = default;
  /// @param path   file; no entries if it is not a regular one.
  /// @param begin  first byte to read, at the beginning of a line.
  explicit EarlierLines(const std::filesystem::path& path, std::int64_t begin = 0);

  /// Return the line of an entry, without its end; none if the file has none.
  /// @param entry  number, never below that of an earlier call.
  [[nodiscard]] std::optional<std::string_view> Find(std::int64_t entry);

  /// Return the next line with its entry's number; none behind the last.
  [[nodiscard]] std::optional<std::string_view> Next();
  /// Number of the entry that Next or Find stands at; 0 before the first.
  [[nodiscard]] std::int64_t entry() const { return entry_; }

 private:
  std::ifstream stream_;
  std::string line_;
  std::int64_t entry_ = 0;
};

}  // namespace regrasp::apps
