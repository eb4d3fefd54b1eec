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
#include <cctype>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
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

std::string LowerSuffix(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  std::ranges::transform(suffix, suffix.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

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
  // Reading in pieces also limits pipes and devices that never end.
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

/// Mark in the name of a temporary file, before its random digits.
constexpr std::string_view kAsideMark = ".tmp";
constexpr std::string_view kDigits = "0123456789abcdef";
constexpr std::size_t kAsideDigits = 16;

/// Limit of the kernel.
constexpr int kMostLinks = 40;

/// Mode of a new file before the process's umask.
constexpr mode_t kNewMode = 0666;
/// Mode of a temporary file that replaces a file with another mode.
constexpr mode_t kOwnMode = 0600;
constexpr mode_t kPermissions = 0777;

[[noreturn]] void FailWith(int error) { throw std::system_error(error, std::generic_category()); }

/// Target of WriteFile.
struct Target {
  enum class Kind {
    kNew,         ///< path without a file
    kFile,        ///< regular file, which is replaced
    kOther,       ///< special file, which is opened and written to
    kDescriptor,  ///< descriptor of this process, which is written to
  };
  Kind kind = Kind::kNew;
  fs::path path;            ///< path without links, except for kOther
  int descriptor = -1;      ///< kDescriptor
  struct stat status = {};  ///< kFile and kOther
};

/// Return the descriptor of this process that a path denotes (/proc/self/fd/1); −1 if there is
/// none.
/// By name, a file would be written from its beginning, and a socket could not be opened.
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

/// Follow links as the kernel does.
/// @throws std::system_error  if a link or a folder of the path must not be followed.
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
    // stat() comes first because the kernel can forbid to follow the link (links in /tmp).
    const bool dangling = stat(at.c_str(), &status) != 0;
    if (dangling && errno != ENOENT) FailWith(errno);
    const fs::path next = at.parent_path() / fs::read_symlink(at);
    // The text of a link in /proc can differ from its target, which can be a pipe or a removed
    // file.
    struct stat seen;
    if (!dangling && (stat(next.c_str(), &seen) != 0 || !IsSameFile(seen, status))) {
      return {Target::Kind::kOther, at, -1, status};
    }
    at = next;
  }
  FailWith(ELOOP);
}

/// Wrap the result of open().
/// @throws std::system_error  if open() failed.
Descriptor Opened(int number) {
  if (number < 0) FailWith(errno);
  return Descriptor(number);
}

/// Close a file and check for errors. Some file systems report lost bytes only at this point.
void Close(Descriptor& file) {
  if (close(file.Release()) != 0) FailWith(errno);
}

/// Guard that blocks signals that stop the process.
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

/// Return a name for a temporary file in the same folder, so that it can be renamed. The name is
/// random so that nobody can create the file first.
fs::path AsideName(const fs::path& path) {
  const std::string ending = std::string(kAsideMark) + RandomDigits();
  const std::string name = path.filename().string().substr(0, NAME_MAX - ending.size());
  return path.parent_path() / (name + ending);
}

/// Temporary file that replaces a file; it is removed unless TakePlace is called.
class FileAside {
 public:
  /// @param target  kFile or kNew.
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
    // Root can change the owner, other users can choose one of their groups.
    if (fchown(file_.get(), target_.status.st_uid, target_.status.st_gid) != 0 &&
        fchown(file_.get(), static_cast<uid_t>(-1), target_.status.st_gid) != 0) {
      mode &= ~static_cast<mode_t>(S_IRWXG);  // the permissions are those of another group
    }
    if (fchmod(file_.get(), mode) != 0) FailWith(errno);
  }

  Target target_;
  fs::path path_;
  Descriptor file_;
  bool renamed_ = false;
};

/// Check that a target is writable.
/// @throws std::system_error  if not.
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
      // Block devices are rejected to prevent data loss; sockets cannot be written by name.
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
    // Without O_CREAT no file is created if the special file has disappeared.
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
    // Permissions do not suffice: the disk can be read-only, or the name too long.
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

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF"sv;

struct EncodingMark {
  std::string_view mark;
  std::string_view encoding;
};

/// The marks of UTF-32 come first because the little-endian one begins with that of UTF-16.
constexpr auto kMarks = std::to_array<EncodingMark>({{"\xFF\xFE\0\0"sv, "UTF-32"sv},
                                                     {"\0\0\xFE\xFF"sv, "UTF-32"sv},
                                                     {"\xFF\xFE"sv, "UTF-16"sv},
                                                     {"\xFE\xFF"sv, "UTF-16"sv}});

/// Return the encoding of text in UTF-16 or UTF-32, otherwise nullopt.
/// ASCII text has no zero bytes; in UTF-16 every second byte of it is zero.
std::optional<std::string_view> WideEncoding(std::string_view bytes) {
  for (const auto& [mark, encoding] : kMarks) {
    if (bytes.starts_with(mark)) return encoding;
  }
  constexpr std::size_t kTwoCharacters = 4;
  if (bytes.size() < kTwoCharacters) return std::nullopt;
  const auto is_zero = [&](std::size_t k) { return bytes[k] == '\0'; };
  const bool low_first = !is_zero(0) && is_zero(1) && !is_zero(2) && is_zero(3);
  const bool high_first = is_zero(0) && !is_zero(1) && is_zero(2) && !is_zero(3);
  if (low_first || high_first) return "UTF-16"sv;
  const bool low_of_four = !is_zero(0) && is_zero(1) && is_zero(2) && is_zero(3);
  const bool high_of_four = is_zero(0) && is_zero(1) && is_zero(2) && !is_zero(3);
  if (low_of_four || high_of_four) return "UTF-32"sv;
  return std::nullopt;
}

}  // namespace

std::string_view TextOf(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with(kUtf8Mark)) return bytes.substr(kUtf8Mark.size());
  if (const auto encoding = WideEncoding(bytes)) {
    throw InputError(name + ": text encoding: not supported, expected UTF-8, found " +
                     std::string(*encoding) + "; help: save the file as UTF-8");
  }
  return bytes;
}

}  // namespace regrasp
