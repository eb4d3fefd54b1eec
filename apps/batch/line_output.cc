#include "apps/batch/line_output.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "apps/batch/line_records.h"
#include "planner/base/error.h"
#include "planner/base/file.h"

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

namespace fs = std::filesystem;

namespace {

/// Maximum time to wait for a lock: children of a killed run need a moment to end.
constexpr std::chrono::milliseconds kPatience{2000};
constexpr std::chrono::milliseconds kBetweenTries{20};

/// Number of bytes copied at a time.
constexpr std::int64_t kPieceBytes = std::int64_t{1} << 22;

/// Permissions of a new file, before the process's umask.
constexpr mode_t kNewMode = 0666;

bool Lock(int descriptor) {
  for (std::chrono::milliseconds waited{0};; waited += kBetweenTries) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK || waited >= kPatience) return false;
    std::this_thread::sleep_for(kBetweenTries);
  }
}

/// Return the first line of a file, with its line end if there is one.
std::string FirstLine(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  // A header has about 200 bytes.
  for (char c = 0; line.size() < (std::size_t{1} << 12) && stream.get(c);) {
    line += c;
    if (c == '\n') break;
  }
  return line;
}

}  // namespace

LinesOutput::LinesOutput(fs::path path, const LinesHeader& header, bool fresh)
    : path_(EndOfLinks(path)),
      part_(path_.string() + kPartEnding),
      rest_(part_.string() + kRestEnding),
      header_(header),
      file_(-1),
      next_(header.range().first) {
  do {
    if (!fresh && OpenWhole()) return;
  } while (!HoldPart());
  TakePart(fresh);
}

bool LinesOutput::HoldPart() {
  file_ = Descriptor(open(part_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, kNewMode));
  if (file_.get() < 0) FailWith(std::strerror(errno));
  if (!Lock(file_.get())) FailWith("locked, another process writes this file");
  // The process that held the lock may have renamed the part.
  struct stat held, there;
  // Reading a pipe would block.
  if (fstat(file_.get(), &held) == 0 && !S_ISREG(held.st_mode)) {
    throw InputError(part_.string() + ": cannot be replaced, expected a regular file or none");
  }
  return fstat(file_.get(), &held) == 0 && lstat(part_.c_str(), &there) == 0 &&
         held.st_dev == there.st_dev && held.st_ino == there.st_ino;
}

bool LinesOutput::OpenWhole() {
  std::error_code error;
  if (!fs::is_regular_file(path_, error) || FirstLine(path_) != FormatHeader(header_)) return false;
  kept_in_ = Kept::kWhole;
  kept_bytes_ = static_cast<std::int64_t>(FormatHeader(header_).size());
  keeping_.open(path_, std::ios::binary);
  keeping_.seekg(kept_bytes_);
  return true;
}

void LinesOutput::TakePart(bool fresh) {
  const std::string expected = FormatHeader(header_);
  const std::string found = FirstLine(part_);
  const bool same = found == expected;
  const auto kept = static_cast<std::int64_t>(expected.size());
  if (!fresh && same && kept_in_ == Kept::kNowhere) {
    kept_in_ = Kept::kPart;
    kept_bytes_ = kept;
    keeping_.open(part_, std::ios::binary);
    keeping_.seekg(kept);
    return;
  }
  // A process that was killed immediately has left nothing, or the beginning of a header.
  const bool begins = expected.starts_with(found);
  const bool ours =
      begins ||
      ParseHeader(found.substr(0, found.find('\n')), part_.string() + ": line 1").has_value();
  if (!ours || (!fresh && !begins)) {
    throw InputError(part_.string() + ": line 1: " +
                     (ours
                          ? "belongs to an interrupted run with different input, options or build; "
                            "help: pass --restart to discard it"
                          : "cannot overwrite a file that regrasp did not write; help: move it") +
                     ", or pass another output");
  }
  if (fresh) {
    unlink(rest_.c_str());
  } else if (same) {
    SetRestAside(kept);
  }
  BeginPart();
  if (kept_in_ == Kept::kNowhere && !fresh) {
    earlier_.emplace_back(rest_);
    earlier_.emplace_back(path_);
  }
}

void LinesOutput::BeginPart() {
  if (ftruncate(file_.get(), 0) != 0 || lseek(file_.get(), 0, SEEK_SET) < 0) {
    FailWith(std::strerror(errno));
  }
  Write(file_.get(), FormatHeader(header_));
}

bool LinesOutput::KeepNext(const Accept& accept) {
  if (kept_in_ == Kept::kNowhere) return false;
  std::string line;
  if (next_ <= header_.range().last && std::getline(keeping_, line) && !keeping_.eof() &&
      OutcomeOf(line, next_) && accept(line)) {
    Count(line);
    ++kept_;
    kept_bytes_ += static_cast<std::int64_t>(line.size()) + 1;
    return true;
  }
  EndKeeping();
  return false;
}

void LinesOutput::EndKeeping() {
  if (kept_in_ == Kept::kNowhere) return;
  std::int64_t begin = 0;
  if (kept_in_ == Kept::kWhole) {
    while (!HoldPart()) {
    }
    TakePart(/*fresh=*/false);
    CopyWhole();
    begin = kept_bytes_;
  } else {
    SetRestAside(kept_bytes_);
    if (ftruncate(file_.get(), kept_bytes_) != 0) FailWith(std::strerror(errno));
  }
  if (lseek(file_.get(), 0, SEEK_END) < 0) FailWith(std::strerror(errno));
  keeping_.close();
  kept_in_ = Kept::kNowhere;
  earlier_.emplace_back(rest_);
  earlier_.emplace_back(path_, begin);
}

/// Copy the file that was opened, even if another process has replaced it meanwhile.
void LinesOutput::CopyWhole() {
  keeping_.clear();
  keeping_.seekg(0);
  std::int64_t left = kept_bytes_;
  std::string piece(static_cast<std::size_t>(std::min(left, kPieceBytes)), '\0');
  if (ftruncate(file_.get(), 0) != 0 || lseek(file_.get(), 0, SEEK_SET) < 0) {
    FailWith(std::strerror(errno));
  }
  while (left > 0) {
    piece.resize(static_cast<std::size_t>(std::min(left, kPieceBytes)));
    if (!keeping_.read(piece.data(), static_cast<std::streamsize>(piece.size()))) {
      FailWith(path_.string() + " was changed during the run");
    }
    Write(file_.get(), piece);
    left -= static_cast<std::int64_t>(piece.size());
  }
}

/// Copy the entries of the part after `begin`, and the entries of an older rest file that follow
/// them, to the rest file.
void LinesOutput::SetRestAside(std::int64_t begin) {
  EarlierLines last(part_, begin), older(rest_);
  if (!last.Next()) return;
  const fs::path aside = rest_.string() + ".new";
  Descriptor file(
      open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, kNewMode));
  if (file.get() < 0) FailWith(std::strerror(errno));
  EarlierLines lines(part_, begin);
  while (const auto line = lines.Next()) Write(file.get(), std::string(*line) + "\n");
  while (const auto line = older.Next()) {
    if (older.entry() > lines.entry()) Write(file.get(), std::string(*line) + "\n");
  }
  if (fsync(file.get()) != 0 || rename(aside.c_str(), rest_.c_str()) != 0) {
    FailWith(std::strerror(errno));
  }
}

std::optional<std::string> LinesOutput::FindEarlier(std::int64_t entry, const Accept& accept) {
  EndKeeping();
  for (EarlierLines& lines : earlier_) {
    const auto line = lines.Find(entry);
    if (!line || !OutcomeOf(*line, entry) || !accept(*line)) continue;
    ++kept_;
    return std::string(*line);
  }
  return std::nullopt;
}

void LinesOutput::Count(std::string_view line) {
  const std::optional<Outcome> outcome = OutcomeOf(line, next_);
  if (!outcome) throw std::logic_error("expected the line of entry " + std::to_string(next_));
  ++counts_[*outcome];
  ++next_;
}

void LinesOutput::Write(int file, std::string_view text) const {
  try {
    WriteAll(file, text);
  } catch (const std::system_error& error) {
    FailWith(error.code().message());
  }
}

void LinesOutput::Append(std::string_view lines) {
  EndKeeping();
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin);
    Count(lines.substr(begin, end - begin));
    begin = end + 1;
  }
  Write(file_.get(), lines);
  if (fdatasync(file_.get()) != 0) FailWith(std::strerror(errno));
}

void LinesOutput::Finish() {
  if (kept_in_ == Kept::kWhole) {
    std::error_code error;
    const bool whole = next_ > header_.range().last &&
                       static_cast<std::int64_t>(fs::file_size(path_, error)) == kept_bytes_;
    if (whole && !error) return;  // already complete
  }
  EndKeeping();
  if (fsync(file_.get()) != 0 || rename(part_.c_str(), path_.c_str()) != 0) {
    FailWith(std::strerror(errno));
  }
  unlink(rest_.c_str());
}

void LinesOutput::Discard() {
  if (file_.get() < 0) return;
  unlink(part_.c_str());
  unlink(rest_.c_str());
}

void LinesOutput::FailWith(const std::string& what) const {
  throw EnvironmentError(part_.string() + ": cannot be written: " + what);
}

}  // namespace regrasp::apps
