#include "apps/locked_output_folder.h"

#include <fcntl.h>
#include <limits.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

#include "planner/base/error.h"

namespace regrasp::apps {

namespace {

namespace fs = std::filesystem;

/// Start of every line of the file, by which files of regrasp are recognized.
constexpr std::string_view kOurs = "regrasp: ";
constexpr std::string_view kHolder = "regrasp: process ";
constexpr std::string_view kWrites = "regrasp: writes ";

/// Time between two attempts to lock a folder.
constexpr std::chrono::milliseconds kPause{10};

/// Maximum number of bytes that are read; the file is far smaller.
constexpr off_t kMostBytes = off_t{1} << 24;

std::string HostName() {
  std::array<char, HOST_NAME_MAX + 1> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string ReadAll(const Descriptor& file) {
  std::string text;
  std::array<char, 1 << 12> piece;
  ssize_t count = 0;
  while (static_cast<off_t>(text.size()) < kMostBytes &&
         (count = pread(file.get(), piece.data(), piece.size(), static_cast<off_t>(text.size()))) >
             0) {
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
  return text;
}

/// Return the text after `mark` of each line that starts with it.
std::vector<std::string> LinesWith(std::string_view mark, const std::string& text) {
  std::vector<std::string> found;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(mark)) found.push_back(line.substr(mark.size()));
  }
  return found;
}

[[noreturn]] void FailWith(const fs::path& path, int error) {
  throw EnvironmentError(path.string() + ": " + std::strerror(error));
}

/// Open the run file, and make the file and its folder if they do not exist.
/// Another process may remove the folder at any time if it is empty.
Descriptor OpenRunFile(const fs::path& folder, const fs::path& file) {
  constexpr mode_t kMode = 0666;
  constexpr int kTries = 1000;
  int failed = 0;
  for (int tries = 0; tries < kTries; ++tries) {
    std::error_code error;
    fs::create_directories(folder, error);
    // The library returns EEXIST if the folder was removed after mkdir failed and before it was
    // checked.
    failed = error.value();
    if (failed == ENOENT || failed == EEXIST) continue;
    if (failed != 0) FailWith(folder, failed);
    Descriptor opened(open(
        file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, kMode));
    if (opened.get() >= 0) return opened;
    if (errno != ENOENT) FailWith(file, errno);
  }
  FailWith(folder, failed == 0 ? ENOENT : failed);
}

/// Return whether the path still refers to the open file.
/// The owner removes the file before it releases the lock. A process that waited for that lock then
/// has a lock on a removed file.
bool IsAt(const fs::path& path, const Descriptor& file) {
  struct stat open, there;
  return fstat(file.get(), &open) == 0 && lstat(path.c_str(), &there) == 0 &&
         open.st_dev == there.st_dev && open.st_ino == there.st_ino;
}

/// Open and lock the run file of a folder.
Descriptor Lock(const fs::path& folder, const fs::path& file, std::chrono::milliseconds patience) {
  for (auto waited = std::chrono::milliseconds(0);; waited += kPause) {
    Descriptor opened = OpenRunFile(folder, file);
    // On a file system without locks, the folder is used without a lock.
    const bool held = flock(opened.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!held && IsAt(file, opened)) return opened;
    if (waited >= patience) {
      const std::vector<std::string> holders = LinesWith(kHolder, ReadAll(opened));
      throw EnvironmentError(
          folder.string() + ": " +
          (holders.empty() ? "another process" : "process " + holders.back()) +
          " writes into this folder; help: wait for it, or pass another --output");
    }
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace

LockedOutputFolder::MadeFolders::MadeFolders(const fs::path& folder) {
  std::error_code error;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, error); at = at.parent_path()) {
    folders_.push_back(at);
  }
  std::ranges::reverse(folders_);
}

LockedOutputFolder::MadeFolders::~MadeFolders() {
  // A folder that is not empty is kept.
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) {
    if (rmdir(folder->c_str()) != 0 && errno != ENOENT) return;
  }
}

LockedOutputFolder::LockedOutputFolder(fs::path path, std::chrono::milliseconds patience)
    : path_(std::move(path)),
      made_(path_),
      file_(path_ / kRunFileName),
      descriptor_(Lock(path_, file_, patience)) {
  struct stat status = {};
  fstat(descriptor_.get(), &status);
  const std::string text = ReadAll(descriptor_);
  if (!S_ISREG(status.st_mode) || (!text.empty() && !text.starts_with(kOurs))) {
    throw InputError(file_.string() +
                     ": cannot overwrite a file that regrasp did not write; help: move it");
  }
  for (const std::string& name : LinesWith(kWrites, text)) left_behind_.insert(name);
  Append(std::string(kHolder) + std::to_string(getpid()) + " on " + HostName() + "\n");
}

LockedOutputFolder::~LockedOutputFolder() {
  if (IsAt(file_, descriptor_)) unlink(file_.c_str());
}

void LockedOutputFolder::Announce(const std::vector<std::string>& names) {
  std::string lines;
  for (const std::string& name : names) lines += std::string(kWrites) + name + "\n";
  Append(lines);
}

void LockedOutputFolder::Append(const std::string& lines) {
  std::string_view rest = lines;
  while (!rest.empty()) {
    const ssize_t count = write(descriptor_.get(), rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) FailWith(file_, count < 0 ? errno : ENOSPC);
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace regrasp::apps
