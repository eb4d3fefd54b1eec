#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "apps/batch/line_records.h"
#include "planner/base/descriptor.h"

namespace regrasp::apps {

/// Behind the name of a file of lines that is being written.
inline constexpr char kPartEnding[] = ".part";

/// A file of lines as it is written, entry by entry in order. It grows beside its place, as
/// NAME.part, and takes its place when all entries stand in it. A process that is killed leaves the
/// part; the next one with the same header goes on behind the last whole entry of it, so that the
/// file has the same bytes however often that happened. What was appended survives the machine,
/// too.
///
/// One process at a time holds the part: by a lock, which goes with the process.
class LinesOutput {
 public:
  /// Takes up what is there of an earlier run: the whole file, or a part.
  /// @param path   of the whole file.
  /// @param fresh  throws away what is there of an earlier run.
  /// @throws InputError        a part is in the way that is of another run, or no part at all.
  /// @throws EnvironmentError  another process writes it, or it cannot be written.
  LinesOutput(std::filesystem::path path, const LinesHeader& header, bool fresh);

  /// The entry that Append is to go on with; behind the last where all are there.
  [[nodiscard]] std::int64_t next() const { return next_; }
  /// What the entries so far came to.
  [[nodiscard]] const Tally& tally() const { return tally_; }
  /// How many of them an earlier run had left.
  [[nodiscard]] std::int64_t kept() const { return kept_; }

  /// @param lines  those of the next entries, each with its end.
  /// @throws EnvironmentError  the disk is full.
  void Append(std::string_view lines);

  /// Puts the file in its place.
  /// @throws EnvironmentError  it cannot be.
  void Finish();

  /// Removes what was written, where the file is not in its place.
  void Discard();

 private:
  [[nodiscard]] bool TakeWhole();
  /// @returns false where the part has gone meanwhile.
  [[nodiscard]] bool HoldPart();
  void TakePart(bool fresh);
  void Count(std::string_view line);
  [[noreturn]] void FailWith(const std::string& what) const;

  std::filesystem::path path_, part_;
  LinesHeader header_;
  Descriptor file_;
  Tally tally_;
  std::int64_t next_;
  std::int64_t kept_ = 0;
};

/// The entries that a file of lines has, one after the other from the first of its header's range;
/// the file may end early or in the middle of a line.
struct LinesSurvey {
  Tally tally;
  std::int64_t entries = 0;  ///< whole ones, up to the first line that is none
  std::int64_t bytes = 0;    ///< up to their end, header included
  bool more = false;         ///< something follows them
};

/// @param header  that the file has. @pre the file can be opened.
[[nodiscard]] LinesSurvey SurveyLines(const std::filesystem::path& path, const LinesHeader& header);

}  // namespace regrasp::apps
