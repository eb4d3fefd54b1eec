#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Maximum length of a line, bytes.
/// It is far above any plan, and far below the memory of a small machine.
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
  /// Return the identity of the entries, which is the same for all shards.
  /// It is the run of the header; without a header it is the SHA-256 of the file.
  [[nodiscard]] const std::string& source() const { return source_; }

  /// Skip to an entry. @param entry  entry number, not below that of the next entry.
  void SkipTo(std::int64_t entry);
  /// Return the next entry of the shard; nullopt at its end.
  /// @throws InputError  if the file has changed since the constructor read it.
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
