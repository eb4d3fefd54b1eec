#include "apps/batch/line_records.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/plan/json_reader.h"

namespace regrasp::apps {

namespace {

constexpr char kHeaderFormat[] = "regrasp-lines";
constexpr char kNoResultFormat[] = "regrasp-none";

/// Beginnings of lines after the entry's number.
constexpr std::array<std::pair<std::string_view, Outcome>, 8> kBeginnings = {{
    {R"("format":"regrasp-plan",)", Outcome::kPlan},
    {R"("format":"regrasp-report","version":1,"verdict":"pass",)", Outcome::kPass},
    {R"("format":"regrasp-report","version":1,"verdict":"fail",)", Outcome::kFail},
    {R"("format":"regrasp-hand-grasp-report","version":1,"verdict":"pass",)", Outcome::kPass},
    {R"("format":"regrasp-hand-grasp-report","version":1,"verdict":"fail",)", Outcome::kFail},
    {R"("format":"regrasp-none","version":1,"verdict":"no-plan",)", Outcome::kNoPlan},
    {R"("format":"regrasp-none","version":1,"verdict":"bad-input",)", Outcome::kBadInput},
    {R"("format":"regrasp-none","version":1,"verdict":"error",)", Outcome::kError},
}};

/// Format JSON on one line. Bytes that are not UTF-8, possible in file names, become U+FFFD.
std::string OnOneLine(const Json& json) {
  return json.dump(-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace);
}

/// Number of hexadecimal digits of a SHA-256.
constexpr std::size_t kDigestDigits = 64;
constexpr std::string_view kInputsMember = R"(,"inputs_sha256":")";
constexpr std::string_view kLineMember = R"(","line_sha256":")";
constexpr std::string_view kSealEnd = R"("})";

std::string RecordBeginning(std::int64_t entry) {
  return R"({"query":)" + std::to_string(entry) + ",";
}

std::optional<int> ShardNumber(std::string_view text) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || number < 1 || number > kMostShards) {
    return std::nullopt;
  }
  return number;
}

}  // namespace

EntryRange Shard::Of(std::int64_t entries) const {
  return {entries * (number - 1) / count + 1, entries * number / count};
}

Shard ParseShard(const std::string& option, const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = ShardNumber(std::string_view(text).substr(0, slash));
    const auto count = ShardNumber(std::string_view(text).substr(slash + 1));
    if (number && count && *number <= *count) return {*number, *count};
  }
  throw InputError(option + ": expected I/N, part I of N, with I from 1 to N and N at most " +
                   std::to_string(kMostShards) + ", found \"" + text + "\"");
}

std::string FormatHeader(const LinesHeader& header) {
  return OnOneLine({{"format", kHeaderFormat},
                    {"version", 1},
                    {"content", header.content},
                    {"entries", header.entries},
                    {"shard", header.shard.number},
                    {"shards", header.shard.count},
                    {"run", header.run}}) +
         "\n";
}

std::optional<LinesHeader> ParseHeader(std::string_view line, const std::string& name) {
  line = TextOf(line, name);
  if (!line.starts_with(R"({"format":"regrasp-lines",)")) return std::nullopt;
  const Json json = ParseJson(line, name);
  const plan::JsonReader root(json, name);
  root.ExpectFormat(kHeaderFormat);
  LinesHeader header;
  header.content = root.Member("content").OneOf({"plans", "reports"});
  const plan::JsonReader entries = root.Member("entries");
  if (entries.Unsigned() > kMostEntries) {
    entries.Fail("too large, limit " + std::to_string(kMostEntries) + " entries");
  }
  header.entries = static_cast<std::int64_t>(entries.Unsigned());
  header.shard.count = root.Member("shards").Integer(1, kMostShards);
  header.shard.number = root.Member("shard").Integer(1, header.shard.count);
  header.run = root.Member("run").String();
  if (FormatHeader(header) != std::string(line) + "\n") {
    throw InputError(name + ": not a header of JSON Lines");
  }
  return header;
}

std::string_view OutcomeName(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPlan:
      return "plan";
    case Outcome::kPass:
      return "pass";
    case Outcome::kFail:
      return "fail";
    case Outcome::kNoPlan:
      return "no-plan";
    case Outcome::kBadInput:
      return "bad-input";
    case Outcome::kError:
      return "error";
  }
  return "";
}

std::string FormatRecord(std::int64_t entry, const Json& json) {
  return RecordBeginning(entry) + OnOneLine(json).substr(1);
}

std::string FormatNoResult(std::int64_t entry, Outcome outcome, const std::string& message) {
  return FormatRecord(entry, {{"format", kNoResultFormat},
                              {"version", 1},
                              {"verdict", std::string(OutcomeName(outcome))},
                              {"message", message}});
}

std::optional<Outcome> OutcomeOf(std::string_view line, std::int64_t entry) {
  const std::string beginning = RecordBeginning(entry);
  if (!line.starts_with(beginning) || !line.ends_with('}')) return std::nullopt;
  line.remove_prefix(beginning.size());
  for (const auto& [begins, outcome] : kBeginnings) {
    if (line.starts_with(begins)) return outcome;
  }
  return std::nullopt;
}

std::optional<std::int64_t> EntryOf(std::string_view line) {
  constexpr std::string_view kBegin = R"({"query":)";
  if (!line.starts_with(kBegin)) return std::nullopt;
  std::int64_t entry = 0;
  const char* end = line.data() + line.size();
  const auto [stop, error] = std::from_chars(line.data() + kBegin.size(), end, entry);
  if (error != std::errc() || stop == end || *stop != ',') return std::nullopt;
  return entry;
}

std::string SealRecord(const std::string& record, std::int64_t entry, const std::string& inputs) {
  const std::optional<Outcome> outcome = OutcomeOf(record, entry);
  if (!outcome || outcome == Outcome::kBadInput || outcome == Outcome::kError) return record;
  std::string sealed = record.substr(0, record.size() - 1);
  sealed.append(kInputsMember).append(inputs);
  const std::string digest = Sha256(sealed);
  return sealed.append(kLineMember).append(digest).append(kSealEnd);
}

std::optional<std::string_view> SealedInputs(std::string_view line) {
  constexpr std::size_t kLineSeal = kLineMember.size() + kDigestDigits + kSealEnd.size();
  constexpr std::size_t kSeal = kInputsMember.size() + kDigestDigits + kLineSeal;
  if (line.size() < kSeal) return std::nullopt;
  const std::string_view sealed = line.substr(0, line.size() - kLineSeal);
  const std::string_view end = line.substr(sealed.size());
  const std::string_view inputs = sealed.substr(sealed.size() - kDigestDigits);
  const std::string_view before = sealed.substr(0, sealed.size() - kDigestDigits);
  if (!before.ends_with(kInputsMember) || !end.starts_with(kLineMember) ||
      !end.ends_with(kSealEnd)) {
    return std::nullopt;
  }
  if (end.substr(kLineMember.size(), kDigestDigits) != Sha256(sealed)) return std::nullopt;
  return inputs;
}

std::string OutcomeCountsText(const OutcomeCounts& outcomes) {
  std::int64_t all = 0;
  std::string counts;
  for (const auto& [outcome, count] : outcomes) {
    all += count;
    counts += (counts.empty() ? ": " : ", ") + std::to_string(count) + " " +
              std::string(OutcomeName(outcome));
  }
  return std::to_string(all) + (all == 1 ? " entry" : " entries") + counts;
}

namespace fs = std::filesystem;

LinesInput::LinesInput(fs::path path, const Shard& shard) : path_(std::move(path)), shard_(shard) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (!fs::exists(status)) throw InputError(path_.string() + ": no such file");
  if (!fs::is_regular_file(status)) {
    throw InputError(path_.string() + ": expected a regular file, because it is read twice");
  }
  stream_.open(path_, std::ios::binary);
  if (!stream_) throw InputError(path_.string() + ": cannot be read: " + std::strerror(errno));
  Survey();
  if (header_) {
    if (shard != Shard() && header_->shard != Shard()) {
      throw InputError(path_.string() + ": --shard cannot be used with a file that is shard " +
                       std::to_string(header_->shard.number) + " of " +
                       std::to_string(header_->shard.count));
    }
    if (shard == Shard()) shard_ = header_->shard;
    const std::int64_t found = lines_ - 1;
    const EntryRange expected = header_->range();
    if (found != expected.count() || !ends_) {
      const std::string where = !ends_ ? ": truncated inside line " + std::to_string(lines_) : "";
      throw InputError(path_.string() + where + ": expected " + std::to_string(expected.count()) +
                       " entries as in the header, found " + std::to_string(found));
    }
    next_ = expected.first;
  }
  SkipTo(range().first);
}

void LinesInput::Survey() {
  Sha256Sum sum;
  std::vector<char> piece(std::size_t{1} << 20);
  std::size_t length = 0;
  char last = '\n';
  while (stream_.read(piece.data(), static_cast<std::streamsize>(piece.size())) ||
         stream_.gcount() > 0) {
    const std::string_view bytes(piece.data(), static_cast<std::size_t>(stream_.gcount()));
    sum.Add(bytes);
    last = bytes.back();
    for (std::size_t begin = 0; begin < bytes.size();) {
      const std::size_t end = bytes.find('\n', begin);
      length += std::min(end, bytes.size()) - begin;
      if (length > kMostLineBytes) {
        throw InputError(path_.string() + ": line " + std::to_string(lines_ + 1) +
                         ": longer than " + std::to_string(kMostLineBytes) + " bytes");
      }
      if (end == std::string_view::npos) break;
      ++lines_;
      length = 0;
      begin = end + 1;
    }
  }
  if (stream_.bad()) {
    throw InputError(path_.string() + ": cannot be read: " + std::strerror(errno));
  }
  ends_ = last == '\n';
  if (!ends_) ++lines_;
  source_ = sum.Finish();
  stream_.clear();
  stream_.seekg(0);
  entries_ = lines_;
  if (lines_ == 0) return;
  header_ = ParseHeader(Get(), path_.string() + ": line 1");
  if (header_) {
    entries_ = header_->entries;
    source_ = header_->run;
  } else {
    stream_.seekg(0);
    next_line_ = 1;
  }
}

std::string LinesInput::Get() {
  std::string text;
  const bool got = static_cast<bool>(std::getline(stream_, text));
  const bool may_lack_end = !ends_ && next_line_ == lines_;
  if (!got || (stream_.eof() && !may_lack_end) || text.size() > kMostLineBytes) {
    throw InputError(path_.string() + ": line " + std::to_string(next_line_) +
                     ": the file changed while it was read");
  }
  ++next_line_;
  if (text.ends_with('\r')) text.pop_back();
  return text;
}

void LinesInput::SkipTo(std::int64_t entry) {
  for (; next_ < entry; ++next_) static_cast<void>(Get());
}

std::optional<Line> LinesInput::Next() {
  if (next_ > range().last) return std::nullopt;
  Line line;
  line.entry = next_++;
  line.name = path_.string() + ": line " + std::to_string(next_line_);
  line.text = Get();
  return line;
}

}  // namespace regrasp::apps
