#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/batch/line_records.h"
#include "planner/base/file.h"

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

/// Suffix of a JSON Lines file that is being written.
inline constexpr char kPartEnding[] = ".part";

/// Suffix, after kPartEnding, for entries of an earlier part that do not follow the kept ones.
inline constexpr char kRestEnding[] = ".rest";

/// Output file of JSON Lines, written entry by entry in order.
/// The file grows as NAME.part in the same folder and is renamed when all entries are written. A
/// killed process leaves the part. Appended entries also survive a crash of the machine.
///
/// Entries of an earlier run are reused one by one, if the caller accepts the line. First
/// `KeepNext` keeps lines in place, from the first entry on: those of a complete file, or of a part
/// with the same header. Then `FindEarlier` searches all results of earlier runs. Neither trusts
/// the content of the files.
///
/// Only one process at a time owns the part. It holds a file lock, which ends with the process.
class LinesOutput {
 public:
  /// Predicate: a line of an earlier run, without its line end, is the current result of its entry.
  using Accept = std::function<bool(std::string_view line)>;

  /// @param path   path of the complete file.
  /// @param fresh  true: discard results of an earlier run.
  /// @throws InputError        if the part is that of another run, or not a part.
  /// @throws EnvironmentError  if another process writes the file, or it cannot be written.
  LinesOutput(std::filesystem::path path, const LinesHeader& header, bool fresh);

  /// Return the entry that Append or KeepNext continues with; one after the last if all are
  /// written.
  [[nodiscard]] std::int64_t next() const { return next_; }
  /// Return the outcome counts of the entries written so far.
  [[nodiscard]] const OutcomeCounts& counts() const { return counts_; }
  /// Return the number of these entries that were reused from an earlier run.
  [[nodiscard]] std::int64_t kept() const { return kept_; }

  /// Keep the line of the next entry in place.
  /// @returns false if there is none, if it is not accepted, or if an earlier entry was not kept.
  /// @throws InputError, EnvironmentError  as the constructor.
  bool KeepNext(const Accept& accept);

  /// Return the line of an entry from an earlier run, without its line end, for Append.
  /// @param entry  entry number, ascending from call to call.
  /// @returns nullopt if there is no accepted line.
  [[nodiscard]] std::optional<std::string> FindEarlier(std::int64_t entry, const Accept& accept);

  /// @param lines  lines of the next entries, each with its line end.
  /// @throws EnvironmentError  if the disk is full. @throws InputError, EnvironmentError  as the
  ///     constructor.
  void Append(std::string_view lines);

  /// Rename the part to its final name.
  /// @throws EnvironmentError  if that fails.
  void Finish();

  /// Remove the part, unless it was renamed to its final name.
  void Discard();

 private:
  /// Source of the lines for KeepNext.
  enum class Kept { kNowhere, kWhole, kPart };

  [[nodiscard]] bool OpenWhole();
  /// @returns false if the part has disappeared meanwhile.
  [[nodiscard]] bool HoldPart();
  void TakePart(bool fresh);
  void BeginPart();
  void EndKeeping();
  void CopyWhole();
  void SetRestAside(std::int64_t begin);
  void Count(std::string_view line);
  [[noreturn]] void FailWith(const std::string& what) const;
  /// Write to the part or the rest file.
  /// @throws EnvironmentError  if it fails, for example on a full disk.
  void Write(int file, std::string_view text) const;

  std::filesystem::path path_, part_, rest_;
  LinesHeader header_;
  Descriptor file_;  ///< descriptor of the part
  OutcomeCounts counts_;
  std::int64_t next_;
  std::int64_t kept_ = 0;
  Kept kept_in_ = Kept::kNowhere;
  std::ifstream keeping_;        ///< file with the lines to keep
  std::int64_t kept_bytes_ = 0;  ///< size of its header and of the kept lines, bytes
  std::vector<EarlierLines> earlier_;
};

}  // namespace regrasp::apps
