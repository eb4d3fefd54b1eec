#include "planner/base/file.h"

#include <fcntl.h>
#include <limits.h>
#include <openssl/evp.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>

#include "planner/base/error.h"

namespace regrasp {

std::string Hexadecimal(std::string_view bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

namespace fs = std::filesystem;

std::string ReadFile(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path.string() + ": no such file");
  if (fs::is_directory(status))
    throw InputError(path.string() + ": expected a file, found a folder");
  const auto fail_large = [&] {
    throw InputError(path.string() + ": too large, limit " + std::to_string(kMaxInputBytes) +
                     " bytes");
  };
  if (fs::is_regular_file(status) && fs::file_size(path, error) > kMaxInputBytes && !error) {
    fail_large();
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string() + ": cannot be read: " + std::strerror(errno));
  // Read in pieces, so that a pipe or a device that never ends meets the limit too.
  std::string bytes;
  std::array<char, 1 << 16> piece;
  while (stream.read(piece.data(), piece.size()) || stream.gcount() > 0) {
    bytes.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > kMaxInputBytes) fail_large();
  }
  if (stream.bad()) throw InputError(path.string() + ": cannot be read");
  return bytes;
}

Sha256Sum::Sha256Sum() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
    throw EnvironmentError("SHA-256 is not available from OpenSSL");
  }
}

void Sha256Sum::Add(std::string_view bytes) {
  EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size());
}

std::string Sha256Sum::Finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
  return Hexadecimal({reinterpret_cast<const char*>(digest.data()), size});
}

std::string Sha256(std::string_view bytes) {
  Sha256Sum sum;
  sum.Add(bytes);
  return sum.Finish();
}

namespace fs = std::filesystem;

namespace {

/// Before the random digits in the name of a file aside.
constexpr std::string_view kAsideMark = ".tmp";
constexpr std::string_view kDigits = "0123456789abcdef";
constexpr std::size_t kAsideDigits = 16;

/// As the kernel's own limit.
constexpr int kMostLinks = 40;

/// Of a new file, less the process's umask.
constexpr mode_t kNewMode = 0666;
/// While a file that will have another's mode is written.
constexpr mode_t kOwnMode = 0600;
constexpr mode_t kPermissions = 0777;

[[noreturn]] void FailWith(int error) { throw std::system_error(error, std::generic_category()); }

/// Where WriteFile writes.
struct Target {
  enum class Kind {
    kNew,         ///< nothing is there yet
    kFile,        ///< a regular file, which is replaced
    kOther,       ///< opened and written to
    kDescriptor,  ///< of this process, written to
  };
  Kind kind = Kind::kNew;
  fs::path path;            ///< without links, but for kOther
  int descriptor = -1;      ///< of kDescriptor
  struct stat status = {};  ///< of kFile and kOther
};

/// The number of the descriptor that the path stands for (/proc/self/fd/1); -1 where it does not.
/// Opened by its name a file would be written from its beginning, and a socket not at all.
int OwnDescriptor(const fs::path& path) {
  const std::string name = path.filename().string();
  int number = -1;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  if (error != std::errc() || stop != end || number < 0) return -1;
  std::error_code missing;
  const fs::path own = fs::canonical("/proc/self/fd", missing);
  if (missing) return -1;
  const fs::path folder = fs::canonical(path.parent_path(), missing);
  return !missing && folder == own ? number : -1;
}

bool IsSameFile(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/// Follows links as the kernel does.
/// @throws std::system_error  a link or a folder on the path may not be followed.
Target Resolve(fs::path at) {
  for (int links = 0; links <= kMostLinks; ++links) {
    if (const int own = OwnDescriptor(at); own >= 0) {
      return {Target::Kind::kDescriptor, at, own};
    }
    struct stat status;
    if (lstat(at.c_str(), &status) != 0) {
      if (errno == ENOENT && at.has_filename()) return {Target::Kind::kNew, at};
      FailWith(errno);
    }
    if (!S_ISLNK(status.st_mode)) {
      const bool file = S_ISREG(status.st_mode);
      return {file ? Target::Kind::kFile : Target::Kind::kOther, at, -1, status};
    }
    // Before its text is believed: the kernel may forbid to follow it (links in /tmp).
    const bool dangling = stat(at.c_str(), &status) != 0;
    if (dangling && errno != ENOENT) FailWith(errno);
    const fs::path next = at.parent_path() / fs::read_symlink(at);
    // The text of a link in /proc need not be where it leads: a pipe, a file that was removed.
    struct stat seen;
    if (!dangling && (stat(next.c_str(), &seen) != 0 || !IsSameFile(seen, status))) {
      return {Target::Kind::kOther, at, -1, status};
    }
    at = next;
  }
  FailWith(ELOOP);
}

/// @param number  what open() returned.
Descriptor Opened(int number) {
  if (number < 0) FailWith(errno);
  return Descriptor(number);
}

/// Some file systems say only now that bytes were lost.
void Close(Descriptor& file) {
  if (close(file.Release()) != 0) FailWith(errno);
}

/// Signals that ask the process to stop wait while this lives.
class StopsHeld {
 public:
  StopsHeld() {
    sigset_t stops;
    sigemptyset(&stops);
    for (const int stop : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&stops, stop);
    pthread_sigmask(SIG_BLOCK, &stops, &before_);
  }
  ~StopsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  StopsHeld(const StopsHeld&) = delete;
  StopsHeld& operator=(const StopsHeld&) = delete;

 private:
  sigset_t before_;
};

std::string RandomDigits() {
  std::string random(kAsideDigits / 2, '\0');
  if (getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size())) {
    FailWith(errno);
  }
  return Hexadecimal(random);
}

/// Beside the file, so that it can be renamed; nobody can guess the name and be there first.
fs::path AsideName(const fs::path& path) {
  const std::string ending = std::string(kAsideMark) + RandomDigits();
  const std::string name = path.filename().string().substr(0, NAME_MAX - ending.size());
  return path.parent_path() / (name + ending);
}

/// A new file that stands beside another until it takes its place; it is removed if it does not.
class FileAside {
 public:
  /// @param target  a file or nothing.
  explicit FileAside(Target target)
      : target_(std::move(target)),
        path_(AsideName(target_.path)),
        file_(Opened(open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                          replaces() ? kOwnMode : kNewMode))) {}
  ~FileAside() {
    if (!renamed_) unlink(path_.c_str());
  }
  FileAside(const FileAside&) = delete;
  FileAside& operator=(const FileAside&) = delete;

  void Write(std::string_view bytes) {
    WriteAll(file_.get(), bytes);
    if (replaces()) KeepModeAndOwner();
  }
  void TakePlace(Durability durability) {
    if (durability == Durability::kSynced && fsync(file_.get()) != 0) FailWith(errno);
    Close(file_);
    if (rename(path_.c_str(), target_.path.c_str()) != 0) FailWith(errno);
    renamed_ = true;
  }

 private:
  [[nodiscard]] bool replaces() const { return target_.kind == Target::Kind::kFile; }

  void KeepModeAndOwner() {
    mode_t mode = target_.status.st_mode & kPermissions;
    // Root may give a file away, others may choose among their groups.
    if (fchown(file_.get(), target_.status.st_uid, target_.status.st_gid) != 0 &&
        fchown(file_.get(), static_cast<uid_t>(-1), target_.status.st_gid) != 0) {
      mode &= ~static_cast<mode_t>(S_IRWXG);  // was for another group
    }
    if (fchmod(file_.get(), mode) != 0) FailWith(errno);
  }

  Target target_;
  fs::path path_;
  Descriptor file_;
  bool renamed_ = false;
};

/// @throws std::system_error  nothing that is written can go there.
void CheckPermitted(const Target& target) {
  switch (target.kind) {
    case Target::Kind::kNew:
      return;
    case Target::Kind::kDescriptor: {
      const int flags = fcntl(target.descriptor, F_GETFL);
      if (flags < 0) FailWith(errno);
      if ((flags & O_ACCMODE) == O_RDONLY) FailWith(EBADF);
      return;
    }
    case Target::Kind::kOther:
      if (S_ISDIR(target.status.st_mode)) FailWith(EISDIR);
      // Nobody means to lose a disk, or can write to a socket by its name.
      if (S_ISBLK(target.status.st_mode) || S_ISSOCK(target.status.st_mode)) FailWith(ENXIO);
      break;
    case Target::Kind::kFile:
      break;
  }
  if (faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0) FailWith(errno);
}

void WriteTo(const Target& target, std::string_view bytes, Durability durability) {
  CheckPermitted(target);
  if (target.kind == Target::Kind::kDescriptor) {
    WriteAll(target.descriptor, bytes);
  } else if (target.kind == Target::Kind::kOther) {
    // Without O_CREAT: what is there is written to, or nothing.
    Descriptor other = Opened(open(target.path.c_str(), O_WRONLY | O_TRUNC | O_NOCTTY | O_CLOEXEC));
    WriteAll(other.get(), bytes);
    Close(other);
  } else {
    const StopsHeld held;
    FileAside aside(target);
    aside.Write(bytes);
    aside.TakePlace(durability);
  }
}

template <class Action>
void NamingPath(const fs::path& path, const Action& action) {
  try {
    action();
  } catch (const std::system_error& error) {
    throw EnvironmentError(path.string() + ": cannot be written: " + error.code().message());
  }
}

}  // namespace

void WriteAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(descriptor, bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {
      pollfd ready = {descriptor, POLLOUT, 0};
      poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      FailWith(errno);
    }
  }
}

void WriteFile(const fs::path& path, std::string_view bytes, Durability durability) {
  NamingPath(path, [&] { WriteTo(Resolve(path), bytes, durability); });
}

void CheckWritable(const fs::path& path) {
  NamingPath(path, [&] {
    const Target target = Resolve(path);
    CheckPermitted(target);
    if (target.kind != Target::Kind::kNew && target.kind != Target::Kind::kFile) return;
    // Permissions alone do not tell: the disk may be read-only, the name too long.
    const StopsHeld held;
    const FileAside tried(target);
  });
}

void CheckFolderWritable(const fs::path& folder) {
  NamingPath(folder, [&] {
    fs::path at = folder;
    struct stat status;
    while (lstat(at.c_str(), &status) != 0) {
      if (errno != ENOENT) FailWith(errno);
      if (at == ".") FailWith(ENOENT);
      at = at.has_parent_path() ? at.parent_path() : ".";
    }
    if (stat(at.c_str(), &status) != 0) FailWith(errno);
    if (!S_ISDIR(status.st_mode)) FailWith(ENOTDIR);
    const StopsHeld held;
    const FileAside tried({Target::Kind::kNew, at / ""});
  });
}

fs::path EndOfLinks(const fs::path& path) {
  try {
    return Resolve(path).path;
  } catch (const std::system_error&) {
    return path;
  }
}

std::string NameBesideAside(const std::string& name) {
  const std::size_t ending = kAsideMark.size() + kAsideDigits;
  if (name.size() <= ending) return "";
  const std::size_t mark = name.size() - ending;
  const bool aside = name.compare(mark, kAsideMark.size(), kAsideMark) == 0 &&
                     name.find_first_not_of(kDigits, mark + kAsideMark.size()) == std::string::npos;
  return aside ? name.substr(0, mark) : "";
}

}  // namespace regrasp
