#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace regrasp::apps {

/// Reader of the entries in a JSON Lines file of an earlier run, as a stream.
///
/// The file may be missing, truncated, edited, or of other entries. It skips lines that are
/// incomplete, that do not begin like an entry, or whose numbers do not ascend. It may skip lines
/// without a seal (SealRecord).
class EarlierLines {
 public:
  /// Create a reader without entries.
  EarlierLines() = default;
  /// @param path   file; a path that is not a regular file has no entries.
  /// @param begin  offset of the first byte to read, at the beginning of a line.
  explicit EarlierLines(const std::filesystem::path& path, std::int64_t begin = 0);

  /// Return the line of an entry, without its line end; nullopt if the file does not contain it.
  /// @param entry  entry number, not below that of an earlier call.
  [[nodiscard]] std::optional<std::string_view> Find(std::int64_t entry);

  /// Return the next line that is an entry; nullopt after the last.
  [[nodiscard]] std::optional<std::string_view> Next();
  /// Return the number of the current entry of Next or Find; 0 before the first.
  [[nodiscard]] std::int64_t entry() const { return entry_; }

 private:
  std::ifstream stream_;
  std::string line_;
  std::int64_t entry_ = 0;
};

}  // namespace regrasp::apps
