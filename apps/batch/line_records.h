#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "planner/base/json.h"

namespace regrasp::apps {

/// Range of entries of a JSON Lines file, numbered from 1; empty if last < first.
struct EntryRange {
  std::int64_t first = 1;
  std::int64_t last = 0;

  [[nodiscard]] std::int64_t count() const { return last - first + 1; }
  bool operator==(const EntryRange&) const = default;
};

/// Shard `number` of `count`; 1 of 1 contains all entries.
struct Shard {
  int number = 1;
  int count = 1;

  /// Return the entries of the shard, which are consecutive. The shards in order cover every entry
  /// once, and their sizes differ by at most one entry.
  /// @param entries  number of entries of the whole, at most kMostEntries.
  [[nodiscard]] EntryRange Of(std::int64_t entries) const;
  bool operator==(const Shard&) const = default;
};

inline constexpr int kMostShards = 1'000'000;
inline constexpr std::int64_t kMostEntries = 1'000'000'000'000;

/// Parse a shard such as "2/4".
/// @throws InputError  if the text is not a shard; the message names the option and the text.
[[nodiscard]] Shard ParseShard(const std::string& option, const std::string& text);

/// Header: first line of a file that a program has written. It describes the other lines.
struct LinesHeader {
  std::string content;       ///< content type, "plans" or "reports"
  std::int64_t entries = 0;  ///< number of entries of the whole, including other shards
  Shard shard;
  std::string run;  ///< SHA-256 of all inputs of the lines

  [[nodiscard]] EntryRange range() const { return shard.Of(entries); }
  bool operator==(const LinesHeader&) const = default;
};

/// Format the header line, with its line end.
[[nodiscard]] std::string FormatHeader(const LinesHeader& header);

/// @param name  name of the line in messages.
/// @returns nullopt if the line is not a header.
/// @throws InputError  if it is an invalid header.
[[nodiscard]] std::optional<LinesHeader> ParseHeader(std::string_view line,
                                                     const std::string& name);

/// Outcome of an entry, as recorded in its line.
enum class Outcome {
  kPlan,      ///< plan found
  kPass,      ///< report with verdict pass
  kFail,      ///< report with verdict fail
  kNoPlan,    ///< no plan found
  kBadInput,  ///< invalid input line
  kError,     ///< process crashed or was stopped
};

/// Return the name: "plan", "pass", "fail", "no-plan", "bad-input" or "error".
[[nodiscard]] std::string_view OutcomeName(Outcome outcome);

/// Format a line, without its line end: `json`, preceded by the entry's number.
/// @param json  object whose first members are format, version and, except for plans, verdict.
[[nodiscard]] std::string FormatRecord(std::int64_t entry, const Json& json);

/// Format the line of an entry without a result.
/// @param outcome  kNoPlan, kBadInput or kError.
[[nodiscard]] std::string FormatNoResult(std::int64_t entry, Outcome outcome,
                                         const std::string& message);

/// Return the outcome in a line of FormatRecord or FormatNoResult, based on its beginning and end.
/// @param line  text without its line end.
/// @returns nullopt if it is not the complete line of this entry.
[[nodiscard]] std::optional<Outcome> OutcomeOf(std::string_view line, std::int64_t entry);

/// Return the number of the entry that begins the line; nullopt if it is not the line of an entry.
[[nodiscard]] std::optional<std::int64_t> EntryOf(std::string_view line);

/// Append two digests to a record.
/// `inputs_sha256` is that of all inputs of the result, `line_sha256` that of the line before it.
/// The first determines whether a later run may reuse the result. The second detects an edited
/// line. It is not a signature: anyone who edits a line can seal it again.
///
/// A record of bad input or of an error is returned unchanged, so that no run reuses it: its cause
/// may lie outside the inputs.
/// @param record  complete line of the entry, without its line end.
/// @param inputs  64 hexadecimal digits.
[[nodiscard]] std::string SealRecord(const std::string& record, std::int64_t entry,
                                     const std::string& inputs);

/// Return the digest of the inputs in a line of SealRecord.
/// @returns nullopt if the line has no seal or was edited after sealing.
[[nodiscard]] std::optional<std::string_view> SealedInputs(std::string_view line);

/// Number of entries per outcome.
using OutcomeCounts = std::map<Outcome, std::int64_t>;

/// Return the counts as text: "1000 entries: 990 pass, 8 fail, 2 no-plan".
[[nodiscard]] std::string OutcomeCountsText(const OutcomeCounts& counts);

}  // namespace regrasp::apps
