#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/line_records.h"

namespace regrasp::apps {

/// A line longer than this is refused: far above any plan, far below the memory of a small machine.
inline constexpr std::size_t kMostLineBytes = std::size_t{1} << 28;

/// An entry of a file of lines.
struct Line {
  std::int64_t entry = 0;   ///< its number
  std::string name;         ///< how messages call it: "plans.jsonl: line 18"
  std::string text;         ///< without its end, "\n" or "\r\n"
  std::string inputs = {};  ///< digest of all that its result depends on; empty: never reused
};

/// A file of JSON Lines that is read as a stream: an entry a line, numbered from 1. It may have
/// been written by a program of ours, or be one of the shards of such a file; its header then says
/// which entries stand in it, and they are numbered as in the whole. A last line may lack its end
/// where no header counts them.
///
/// Memory does not grow with the file.
class LinesInput {
 public:
  /// Goes through the file once, to count and digest it, and then to the first entry of the shard.
  /// @param shard  of the file's entries; of a file that is itself a shard, 1 of 1.
  /// @throws InputError  names the file: it is no regular file, a line is too long, it does not
  ///                     hold the entries that its header says, or is a shard and shall be cut
  ///                     again.
  explicit LinesInput(std::filesystem::path path, const Shard& shard = {});

  [[nodiscard]] const std::optional<LinesHeader>& header() const { return header_; }
  /// Of the whole, of which this may be a shard.
  [[nodiscard]] std::int64_t entries() const { return entries_; }
  /// Which shard of the whole Next goes through: of the file, or the file itself.
  [[nodiscard]] const Shard& shard() const { return shard_; }
  [[nodiscard]] EntryRange range() const { return shard_.Of(entries_); }
  /// What the entries are, whichever shard they stand in: the run of the header, or else the
  /// SHA-256 of the file.
  [[nodiscard]] const std::string& source() const { return source_; }

  /// Goes on with this entry. @param entry  not before the next one.
  void SkipTo(std::int64_t entry);
  /// The next entry of the shard; none at its end.
  /// @throws InputError  the file has changed.
  [[nodiscard]] std::optional<Line> Next();

 private:
  void Survey();
  [[nodiscard]] std::string Get();

  std::filesystem::path path_;
  std::ifstream stream_;
  std::optional<LinesHeader> header_;
  std::int64_t entries_ = 0;
  std::int64_t lines_ = 0;  ///< of the file, with its header
  bool ends_ = true;        ///< so does the last of them
  Shard shard_;
  std::string source_;
  std::int64_t next_ = 1;       ///< entry
  std::int64_t next_line_ = 1;  ///< of the file
};

}  // namespace regrasp::apps
