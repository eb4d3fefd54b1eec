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

#include "planner/base/error.h"
#include "planner/base/write_file.h"

namespace regrasp::apps {

namespace fs = std::filesystem;

namespace {

/// How long a part is waited for: the children of a run that was killed take an instant to go.
constexpr std::chrono::milliseconds kPatience{2000};
constexpr std::chrono::milliseconds kBetweenTries{20};

/// Of a new file, less the process's umask.
constexpr mode_t kNewMode = 0666;

bool Lock(int descriptor) {
  for (std::chrono::milliseconds waited{0};; waited += kBetweenTries) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK || waited >= kPatience) return false;
    std::this_thread::sleep_for(kBetweenTries);
  }
}

/// The first line of a file, with its end; shorter where the file is.
std::string FirstLine(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  // A header has some 200 bytes.
  for (char c = 0; line.size() < (std::size_t{1} << 12) && stream.get(c);) {
    line += c;
    if (c == '\n') break;
  }
  return line;
}

}  // namespace

LinesSurvey SurveyLines(const fs::path& path, const LinesHeader& header) {
  LinesSurvey survey;
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  survey.bytes = static_cast<std::int64_t>(line.size()) + 1;
  const EntryRange range = header.range();
  while (survey.entries < range.count() && std::getline(stream, line) && !stream.eof()) {
    const auto outcome = OutcomeOf(line, range.first + survey.entries);
    if (!outcome) break;
    ++survey.tally[*outcome];
    ++survey.entries;
    survey.bytes += static_cast<std::int64_t>(line.size()) + 1;
  }
  std::error_code error;
  survey.more = static_cast<std::int64_t>(fs::file_size(path, error)) != survey.bytes;
  return survey;
}

LinesOutput::LinesOutput(fs::path path, const LinesHeader& header, bool fresh)
    : path_(EndOfLinks(path)),
      part_(path_.string() + kPartEnding),
      header_(header),
      file_(-1),
      next_(header.range().first) {
  do {
    if (!fresh && TakeWhole()) return;
  } while (!HoldPart());
  TakePart(fresh);
}

bool LinesOutput::HoldPart() {
  file_ = Descriptor(open(part_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, kNewMode));
  if (file_.get() < 0) FailWith(std::strerror(errno));
  if (!Lock(file_.get())) FailWith("another process writes it");
  // The one that was waited for may have put it in its place.
  struct stat held, there;
  return fstat(file_.get(), &held) == 0 && lstat(part_.c_str(), &there) == 0 &&
         held.st_dev == there.st_dev && held.st_ino == there.st_ino;
}

bool LinesOutput::TakeWhole() {
  std::error_code error;
  if (!fs::is_regular_file(path_, error) || FirstLine(path_) != FormatHeader(header_)) return false;
  LinesSurvey survey = SurveyLines(path_, header_);
  // A file that was cut or edited is made again.
  if (survey.entries != header_.range().count() || survey.more) return false;
  tally_ = std::move(survey.tally);
  kept_ = survey.entries;
  next_ += kept_;
  return true;
}

void LinesOutput::TakePart(bool fresh) {
  const std::string expected = FormatHeader(header_);
  const std::string found = FirstLine(part_);
  // A process that was killed at once has left nothing, or a beginning.
  if (!fresh && found == expected) {
    LinesSurvey survey = SurveyLines(part_, header_);
    tally_ = std::move(survey.tally);
    kept_ = survey.entries;
    next_ += kept_;
    if (ftruncate(file_.get(), survey.bytes) != 0) FailWith(std::strerror(errno));
  } else {
    const bool ours =
        expected.starts_with(found) ||
        ParseHeader(found.substr(0, found.find('\n')), part_.string() + ": line 1").has_value();
    if (!ours || (!fresh && !expected.starts_with(found))) {
      throw InputError(part_.string() + ": line 1: " +
                       (ours ? "is the part of a run with other input, other options or another "
                               "build, which was stopped; --fresh throws it away"
                             : "is in the way, and no run of this program has left it") +
                       "; or give another output");
    }
    if (ftruncate(file_.get(), 0) != 0) FailWith(std::strerror(errno));
    WriteAll(file_.get(), expected);
  }
  if (lseek(file_.get(), 0, SEEK_END) < 0) FailWith(std::strerror(errno));
}

void LinesOutput::Count(std::string_view line) {
  const std::optional<Outcome> outcome = OutcomeOf(line, next_);
  if (!outcome) throw std::logic_error("a line is not that of entry " + std::to_string(next_));
  ++tally_[*outcome];
  ++next_;
}

void LinesOutput::Append(std::string_view lines) {
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin);
    Count(lines.substr(begin, end - begin));
    begin = end + 1;
  }
  try {
    WriteAll(file_.get(), lines);
  } catch (const std::system_error& error) {
    FailWith(error.code().message());
  }
  if (fdatasync(file_.get()) != 0) FailWith(std::strerror(errno));
}

void LinesOutput::Finish() {
  if (file_.get() < 0) return;  // it is there already
  if (fsync(file_.get()) != 0 || rename(part_.c_str(), path_.c_str()) != 0) {
    FailWith(std::strerror(errno));
  }
}

void LinesOutput::Discard() {
  if (file_.get() >= 0) unlink(part_.c_str());
}

void LinesOutput::FailWith(const std::string& what) const {
  throw EnvironmentError(part_.string() + ": cannot be written: " + what);
}

}  // namespace regrasp::apps
