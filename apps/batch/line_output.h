#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/batch/earlier_lines.h"
#include "apps/batch/line_records.h"
#include "planner/base/file.h"

namespace regrasp::apps {

/// Behind the name of a file of lines that is being written.
inline constexpr char kPartEnding[] = ".part";

/// Behind the name of a part: entries of an earlier part that do not follow those that were kept.
inline constexpr char kRestEnding[] = ".rest";

/// A file of lines as it is written, entry by entry in order. It grows beside its place, as
/// NAME.part, and takes its place when all entries stand in it. A process that is killed leaves the
/// part. What was appended survives the machine, too.
///
/// Entries of an earlier run are reused one by one, and only if the caller accepts the line. First
/// `KeepNext` keeps lines where they are, from the first entry on: those of a whole file or of a
/// part with the same header. Then `FindEarlier` searches all that earlier runs left. Neither
/// trusts what the files say.
///
/// One process at a time holds the part: by a lock, which goes with the process.
class LinesOutput {
 public:
  /// Decides whether a line of an earlier run, without its end, is the result of its entry now.
  using Accept = std::function<bool(std::string_view line)>;

  /// @param path   of the whole file.
  /// @param fresh  throws away what is there of an earlier run.
  /// @throws InputError        a part is in the way that is of another run, or no part at all.
  /// @throws EnvironmentError  another process writes it, or it cannot be written.
  LinesOutput(std::filesystem::path path, const LinesHeader& header, bool fresh);

  /// The entry that Append or KeepNext continues with; behind the last if all are there.
  [[nodiscard]] std::int64_t next() const { return next_; }
  /// What the entries so far came to.
  [[nodiscard]] const Tally& tally() const { return tally_; }
  /// How many of them an earlier run had left.
  [[nodiscard]] std::int64_t kept() const { return kept_; }

  /// Keep the line of the next entry where it is.
  /// @returns false  if there is none, it is not accepted, or one before was not.
  /// @throws as the constructor.
  bool KeepNext(const Accept& accept);

  /// Return the line that an earlier run left of an entry, without its end, to be appended.
  /// @param entry  number, ascending from call to call.
  /// @returns none  if there is none that is accepted.
  [[nodiscard]] std::optional<std::string> FindEarlier(std::int64_t entry, const Accept& accept);

  /// @param lines  those of the next entries, each with its end.
  /// @throws EnvironmentError  the disk is full. @throws as the constructor.
  void Append(std::string_view lines);

  /// Puts the file in its place.
  /// @throws EnvironmentError  it cannot be.
  void Finish();

  /// Removes what was written, if the file is not in its place.
  void Discard();

 private:
  /// Where KeepNext finds lines.
  enum class Kept { kNowhere, kWhole, kPart };

  [[nodiscard]] bool OpenWhole();
  /// @returns false if the part has gone meanwhile.
  [[nodiscard]] bool HoldPart();
  void TakePart(bool fresh);
  void BeginPart();
  void EndKeeping();
  void CopyWhole();
  void SetRestAside(std::int64_t begin);
  void Count(std::string_view line);
  [[noreturn]] void FailWith(const std::string& what) const;

  std::filesystem::path path_, part_, rest_;
  LinesHeader header_;
  Descriptor file_;  ///< of the part
  Tally tally_;
  std::int64_t next_;
  std::int64_t kept_ = 0;
  Kept kept_in_ = Kept::kNowhere;
  std::ifstream keeping_;        ///< of the file with lines to keep
  std::int64_t kept_bytes_ = 0;  ///< of its header and the lines that were kept
  std::vector<EarlierLines> earlier_;
};

}  // namespace regrasp::apps
