#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "planner/base/json.h"

namespace regrasp::apps {

/// Entries of a file of lines, by their numbers, which begin with 1; none where last < first.
struct EntryRange {
  std::int64_t first = 1;
  std::int64_t last = 0;

  [[nodiscard]] std::int64_t count() const { return last - first + 1; }
  bool operator==(const EntryRange&) const = default;
};

/// Part `number` of `count`; 1 of 1 is all.
struct Shard {
  int number = 1;
  int count = 1;

  /// The entries of the shard, neighbours all. Shards in order cover every entry once, and differ
  /// by at most one entry in size.
  /// @param entries  of the whole, at most kMostEntries.
  [[nodiscard]] EntryRange Of(std::int64_t entries) const;
  bool operator==(const Shard&) const = default;
};

inline constexpr int kMostShards = 1'000'000;
inline constexpr std::int64_t kMostEntries = 1'000'000'000'000;

/// "2/4".
/// @throws InputError  names the option and what was found.
[[nodiscard]] Shard ParseShard(const std::string& option, const std::string& text);

/// Line 1 of a file that a program has written: what its other lines are.
struct LinesHeader {
  std::string content;       ///< "plans" or "reports"
  std::int64_t entries = 0;  ///< of the whole, however many of its shards stand here
  Shard shard;
  std::string run;  ///< SHA-256 of all that the lines come from

  [[nodiscard]] EntryRange range() const { return shard.Of(entries); }
  bool operator==(const LinesHeader&) const = default;
};

/// The line, with its end.
[[nodiscard]] std::string FormatHeader(const LinesHeader& header);

/// @param name  how messages call the line.
/// @returns none where it is no header.
/// @throws InputError  it is one, and a bad one.
[[nodiscard]] std::optional<LinesHeader> ParseHeader(std::string_view line,
                                                     const std::string& name);

/// What became of an entry, by what stands in its line.
enum class Outcome {
  kPlan,      ///< a plan
  kPass,      ///< a report that says so
  kFail,      ///< likewise
  kNoPlan,    ///< no sequence was found
  kBadInput,  ///< the line that was read is no good
  kError,     ///< its process crashed or was stopped
};

/// "plan", "pass", "fail", "no-plan", "bad-input" or "error".
[[nodiscard]] std::string_view OutcomeName(Outcome outcome);

/// A line, without its end: `json` behind the entry's number, which always comes first.
/// @param json  an object whose first members are format, version and, but for plans, verdict.
[[nodiscard]] std::string FormatRecord(std::int64_t entry, const Json& json);

/// The line of an entry without a result.
/// @param outcome  kNoPlan, kBadInput or kError.
[[nodiscard]] std::string FormatNoResult(std::int64_t entry, Outcome outcome,
                                         const std::string& message);

/// What FormatRecord and FormatNoResult have written, told by how the line begins and ends.
/// @param line  without its end.
/// @returns none where it is not the whole line of this entry.
[[nodiscard]] std::optional<Outcome> OutcomeOf(std::string_view line, std::int64_t entry);

/// The number of the entry whose line begins so; none if it is not a line of an entry.
[[nodiscard]] std::optional<std::int64_t> EntryOf(std::string_view line);

/// Add two digests to the end of a record: `inputs_sha256`, of all that the result depends on, and
/// `line_sha256`, of the line before it. The first tells whether a later run may reuse the result,
/// the second whether the line is as it was written. Anyone who edits a line can seal it again: it
/// is not a signature.
///
/// A record of bad input or of an error stays as it is, so that no run ever reuses it: its cause
/// may lie outside the inputs.
/// @param record  the whole line of the entry, without its end.
/// @param inputs  64 hexadecimal digits.
[[nodiscard]] std::string SealRecord(const std::string& record, std::int64_t entry,
                                     const std::string& inputs);

/// The digest of the inputs in a line that SealRecord has written; none if the line has no seal or
/// was edited since.
[[nodiscard]] std::optional<std::string_view> SealedInputs(std::string_view line);

/// How many entries came to what.
using Tally = std::map<Outcome, std::int64_t>;

/// "1000 entries: 990 pass, 8 fail, 2 no-plan".
[[nodiscard]] std::string TallyText(const Tally& tally);

}  // namespace regrasp::apps
