#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/line_records.h"

namespace regrasp::apps {

/// Maximum length of a line, bytes: far above any plan, and far below the memory of a small
/// machine.
inline constexpr std::size_t kMostLineBytes = std::size_t{1} << 28;

/// Entry of a JSON Lines file.
struct Line {
  std::int64_t entry = 0;   ///< number of the entry
  std::string name;         ///< name in messages: "plans.jsonl: line 18"
  std::string text;         ///< text without the line end "\n" or "\r\n"
  std::string inputs = {};  ///< digest of all inputs of its result; empty: never reused
};

/// JSON Lines file that is read as a stream: one entry per line, numbered from 1.
/// The file may have been written by one of our programs, or be a shard of such a file. Its header
/// then states which entries it contains, numbered as in the whole file. Without a header, the last
/// line needs no line end.
///
/// Memory use does not depend on the size of the file.
class LinesInput {
 public:
  /// Read the file once to count and digest it, then move to the first entry of the shard.
  /// @param shard  shard of the file's entries; must be 1 of 1 for a file that is itself a shard.
  /// @throws InputError  if the file is not a regular file, has a line that is too long, does not
  ///     contain the entries that its header states, or is a shard and would be split again. The
  ///     message names the file.
  explicit LinesInput(std::filesystem::path path, const Shard& shard = {});

  [[nodiscard]] const std::optional<LinesHeader>& header() const { return header_; }
  /// Return the number of entries of the whole file, of which this may be a shard.
  [[nodiscard]] std::int64_t entries() const { return entries_; }
  /// Return the shard of the whole that Next reads: the requested one, or the file itself.
  [[nodiscard]] const Shard& shard() const { return shard_; }
  [[nodiscard]] EntryRange range() const { return shard_.Of(entries_); }
  /// Return the identity of the entries, which is the same for all shards: the run of the header if
  /// there is one, the SHA-256 of the file if not.
  [[nodiscard]] const std::string& source() const { return source_; }

  /// Skip to an entry. @param entry  entry number, not below that of the next entry.
  void SkipTo(std::int64_t entry);
  /// Return the next entry of the shard; nullopt at its end.
  /// @throws InputError  if the file has changed.
  [[nodiscard]] std::optional<Line> Next();

 private:
  void Survey();
  [[nodiscard]] std::string Get();

  std::filesystem::path path_;
  std::ifstream stream_;
  std::optional<LinesHeader> header_;
  std::int64_t entries_ = 0;
  std::int64_t lines_ = 0;  ///< number of lines of the file, including its header
  bool ends_ = true;        ///< true if the last line has a line end
  Shard shard_;
  std::string source_;
  std::int64_t next_ = 1;       ///< number of the next entry
  std::int64_t next_line_ = 1;  ///< number of the next line of the file
};

}  // namespace regrasp::apps
