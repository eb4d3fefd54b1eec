#include "apps/batch/merge_lines.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "apps/batch/line_output.h"
#include "planner/base/error.h"

namespace regrasp::apps {

namespace fs = std::filesystem;

namespace {

/// Bytes that are collected before they are written and flushed to the disk.
constexpr std::size_t kPiece = std::size_t{1} << 22;

/// Maximum number of items named in a message.
constexpr int kMostNamed = 5;

std::string ShardText(const Shard& shard) {
  return "shard " + std::to_string(shard.number) + " of " + std::to_string(shard.count);
}

LinesHeader ReadHeader(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(path.string() + ": no such file");
  if (fs::is_directory(path, error)) {
    throw InputError(path.string() + ": expected a file, found a folder");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  const auto header = ParseHeader(line, path.string() + ": line 1");
  if (header) return *header;
  throw InputError(path.string() +
                   ": line 1: expected a header of JSON Lines, as plan --batch and validate write "
                   "them");
}

/// Check that two headers differ only in the shard's number.
void CheckSameRun(const ShardFile& first, const ShardFile& other) {
  LinesHeader expected = first.header;
  const auto refuse = [&](const std::string& what) {
    throw InputError(other.path.string() + ": line 1: " + what + first.path.string());
  };
  if (other.header.content != expected.content) {
    refuse("expected " + expected.content + ", found " + other.header.content +
           "; the first shard is ");
  }
  if (other.header.shard.count != expected.shard.count) {
    refuse("expected a shard of " + std::to_string(expected.shard.count) + ", found " +
           ShardText(other.header.shard) + "; the first shard is ");
  }
  if (other.header.run != expected.run || other.header.entries != expected.entries) {
    refuse("belongs to a run with different input, options or build than ");
  }
}

void CheckComplete(const std::vector<ShardFile>& shards) {
  const int count = shards.front().header.shard.count;
  int missing = 0;
  std::string names;
  auto next = shards.begin();
  for (int number = 1; number <= count; ++number) {
    if (next != shards.end() && next->header.shard.number == number) {
      ++next;
    } else if (++missing <= kMostNamed) {
      names += (names.empty() ? "" : ", ") + std::to_string(number);
    }
  }
  if (missing == 0) return;
  throw InputError("--shards: " + std::to_string(missing) + " of " + std::to_string(count) +
                   " shards not found: numbers " + names + (missing > kMostNamed ? ", …" : ""));
}

/// Reader of a shard, entry by entry.
class ShardReader {
 public:
  explicit ShardReader(const ShardFile& shard)
      : shard_(shard), stream_(shard.path, std::ios::binary) {
    std::string header;
    std::getline(stream_, header);
  }

  /// Return the line of an entry, with its line end.
  std::string Get(std::int64_t entry) {
    std::string line;
    ++line_;
    if (!std::getline(stream_, line)) {
      Fail("entry " + std::to_string(entry) + " not found; the shard ends with entry " +
           std::to_string(shard_.header.range().last));
    }
    if (stream_.eof()) Fail("truncated, expected a line break");
    if (!OutcomeOf(line, entry))
      Fail("expected the result of entry " + std::to_string(entry) + ", found another line");
    return line + "\n";
  }
  void ExpectEnd() {
    ++line_;
    if (stream_.peek() != std::ifstream::traits_type::eof()) {
      Fail("follows the last entry of the shard, " + std::to_string(shard_.header.range().last));
    }
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(shard_.path.string() + ": line " + std::to_string(line_) + ": " + what);
  }

  const ShardFile& shard_;
  std::ifstream stream_;
  std::int64_t line_ = 1;
};

/// Append all entries. Lines that are already present are kept, but all are read.
void AppendShards(const std::vector<ShardFile>& shards, LinesOutput& merged) {
  std::string lines;
  bool keeps = true;
  for (const ShardFile& shard : shards) {
    ShardReader reader(shard);
    const EntryRange range = shard.header.range();
    for (std::int64_t entry = range.first; entry <= range.last; ++entry) {
      const std::string line = reader.Get(entry);
      keeps = keeps && merged.KeepNext([&line](std::string_view there) {
        return line == std::string(there) + "\n";
      });
      if (!keeps) lines += line;
      if (lines.size() < kPiece) continue;
      merged.Append(lines);
      lines.clear();
    }
    reader.ExpectEnd();
  }
  if (!lines.empty()) merged.Append(lines);
}

}  // namespace

std::vector<ShardFile> FindShards(const std::vector<fs::path>& files) {
  std::vector<ShardFile> shards;
  for (const fs::path& file : files) {
    shards.push_back({file, ReadHeader(file)});
    CheckSameRun(shards.front(), shards.back());
  }
  std::ranges::stable_sort(shards, {}, [](const ShardFile& s) { return s.header.shard.number; });
  const auto twice = std::ranges::adjacent_find(
      shards, {}, [](const ShardFile& shard) { return shard.header.shard.number; });
  if (twice != shards.end()) {
    throw InputError((twice + 1)->path.string() + ": line 1: " + ShardText(twice->header.shard) +
                     " must be given once, found it in " + twice->path.string() + " too");
  }
  CheckComplete(shards);
  return shards;
}

OutcomeCounts MergeLines(const std::vector<ShardFile>& shards, const fs::path& output, bool fresh) {
  LinesHeader whole = shards.front().header;
  whole.shard = {};
  LinesOutput merged(output, whole, fresh);
  try {
    AppendShards(shards, merged);
  } catch (...) {
    // Starting again is cheap, and an incomplete file would block the next run.
    merged.Discard();
    throw;
  }
  merged.Finish();
  return merged.counts();
}

}  // namespace regrasp::apps
