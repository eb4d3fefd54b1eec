// Fuzz target: any bytes as a JSON Lines file, as a shard to be merged, and as the part of an
// interrupted run. They must be read entry by entry, merged and continued, or give a one-line
// error.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/batch/line_output.h"
#include "apps/batch/line_records.h"
#include "apps/batch/merge_lines.h"
#include "hostile_input.h"
#include "planner/base/error.h"
#include "planner/base/file.h"

namespace {

using namespace regrasp;
using namespace regrasp::apps;

/// A header may announce 10¹² entries.
constexpr std::int64_t kMostFinished = 64;

constexpr int kShards = 3;

/// Return a folder in memory if there is one, because a run waits for the disk after each line.
std::filesystem::path Temporary() {
  const std::filesystem::path memory = "/dev/shm";
  std::error_code error;
  return std::filesystem::is_directory(memory, error) ? memory
                                                      : std::filesystem::temp_directory_path();
}

/// Temporary folder of this process, removed at its end.
class Folder {
 public:
  Folder() : path_(Temporary() / ("regrasp_lines_fuzz." + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::filesystem::path File(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

const Folder& Scratch() {
  static const Folder folder;
  return folder;
}

/// Messages must name a file, which is always the hostile one. Only messages about missing shards
/// name none.
template <class Read>
void NamingHostile(const std::filesystem::path& file, const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string message = error.what();
    const std::string path = file.string();
    if (message.starts_with(path)) throw InputError(kHostileName + message.substr(path.size()));
    if (!message.starts_with("--shards: ")) ReportFinding("the message names no file: " + message);
    throw InputError(kHostileName + ": " + message);
  }
}

std::vector<std::string> ReadEntries(LinesInput& input) {
  std::vector<std::string> texts;
  std::int64_t expected = input.range().first;
  while (const auto line = input.Next()) {
    if (line->entry != expected++) ReportFinding("an entry is out of order");
    if (line->text.find('\n') != std::string::npos) ReportFinding("an entry of two lines");
    texts.push_back(line->text);
  }
  if (static_cast<std::int64_t>(texts.size()) != input.range().count()) {
    ReportFinding("not as many entries as the shard has");
  }
  return texts;
}

void ReadAll(const std::filesystem::path& file) {
  LinesInput whole(file);
  const std::vector<std::string> texts = ReadEntries(whole);
  if (whole.shard() != Shard()) return;
  std::vector<std::string> joined;
  for (int number = 1; number <= kShards; ++number) {
    LinesInput shard(file, {number, kShards});
    for (std::string& text : ReadEntries(shard)) joined.push_back(std::move(text));
  }
  if (joined != texts) ReportFinding("the shards of a file are not the file");
}

void Merge(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path merged = Scratch().File("merged.jsonl");
  std::filesystem::remove(merged);
  const std::vector<ShardFile> shards = FindShards({file});
  MergeLines(shards, merged, /*fresh=*/true);
  if (ReadFile(merged) != text) ReportFinding("a whole that was merged is not itself");
}

/// Each missing result becomes an error.
void GoOn(const std::filesystem::path& part, std::string_view text) {
  const std::string_view first = text.substr(0, text.find('\n'));
  const auto given = ParseHeader(first, part.string() + ": line 1");
  const LinesHeader header = given.value_or(LinesHeader{"plans", 2, {}, "run"});
  const EntryRange range = header.range();
  if (range.count() > kMostFinished) return;
  std::filesystem::path whole = part;
  whole.replace_extension();  // .part
  std::filesystem::remove(whole);
  LinesOutput output(whole, header, /*fresh=*/false);
  while (output.next() <= range.last &&
         output.KeepNext([](std::string_view /*line*/) { return true; })) {
  }
  while (output.next() <= range.last) {
    output.Append(FormatNoResult(output.next(), Outcome::kError, "stopped") + "\n");
  }
  output.Finish();
  LinesInput done(whole);
  std::int64_t entry = range.first;
  for (auto line = done.Next(); line; line = done.Next()) {
    if (!OutcomeOf(line->text, entry++)) ReportFinding("a run that went on has a bad line");
  }
  if (entry != range.last + 1) ReportFinding("a run that went on is cut");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path file = Scratch().File("lines.jsonl");
  WriteFile(file, text);
  ReadHostileInput([&] { NamingHostile(file, [&] { ReadAll(file); }); });
  ReadHostileInput([&] { NamingHostile(file, [&] { Merge(file, text); }); });
  const std::filesystem::path part = Scratch().File("stopped.jsonl.part");
  WriteFile(part, text);
  ReadHostileInput([&] { NamingHostile(part, [&] { GoOn(part, text); }); });
  return 0;
}
