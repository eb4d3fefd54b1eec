#include "apps/batch/line_input.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp::apps {

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
      throw InputError(path_.string() + ": line " + std::to_string(lines_) + ": truncated " +
                       (ends_ ? "after" : "inside") + " this line, expected " +
                       std::to_string(expected.count()) + " entries as in the header");
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
  if (stream_.bad()) throw InputError(path_.string() + ": cannot be read");
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
