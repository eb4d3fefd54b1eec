#include "apps/batch/earlier_lines.h"

#include <system_error>

#include "apps/batch/line_records.h"

namespace regrasp::apps {

EarlierLines::EarlierLines(const std::filesystem::path& path, std::int64_t begin) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  stream_.open(path, std::ios::binary);
  stream_.seekg(begin);
}

std::optional<std::string_view> EarlierLines::Next() {
  if (!stream_.is_open()) return std::nullopt;
  // A last line without a line end is truncated.
  while (std::getline(stream_, line_) && !stream_.eof()) {
    const std::optional<std::int64_t> entry = EntryOf(line_);
    if (!entry || *entry <= entry_) continue;
    // An edited number would hide all entries up to it.
    if (*entry != entry_ + 1 && !SealedInputs(line_)) continue;
    entry_ = *entry;
    return line_;
  }
  stream_.close();
  return std::nullopt;
}

std::optional<std::string_view> EarlierLines::Find(std::int64_t entry) {
  while (entry_ < entry) {
    if (!Next()) return std::nullopt;
  }
  if (entry_ != entry || !stream_.is_open()) return std::nullopt;
  return line_;
}

}  // namespace regrasp::apps
