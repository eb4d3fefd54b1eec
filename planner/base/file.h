#pragma once

#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

/// OpenSSL's.
struct evp_md_ctx_st;

namespace regrasp {

/// A file descriptor that is closed when it goes.
class Descriptor {
 public:
  /// @param number  negative: none.
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  [[nodiscard]] int get() const { return number_; }
  /// Gives it away, open.
  [[nodiscard]] int Release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

/// The bytes as lower-case hexadecimal digits, two each.
[[nodiscard]] std::string Hexadecimal(std::string_view bytes);

/// The bytes of a file.
/// @throws InputError  the file does not exist, is a folder, cannot be read, or is larger than
///                     `kMaxInputBytes`.
[[nodiscard]] std::string ReadFile(const std::filesystem::path& path);

/// Input files larger than this are refused: far above any mesh that can be planned on, far below
/// the memory of a small machine.
inline constexpr std::size_t kMaxInputBytes = std::size_t{1} << 30;

/// The SHA-256 digest of `bytes`, 64 lower-case hexadecimal digits.
/// @throws EnvironmentError  OpenSSL has none.
[[nodiscard]] std::string Sha256(std::string_view bytes);

/// The same of bytes that come piece by piece, however they are cut.
class Sha256Sum {
 public:
  /// @throws EnvironmentError  OpenSSL has none.
  Sha256Sum();
  void Add(std::string_view bytes);
  /// Of all that was added. To be called once, at the end.
  [[nodiscard]] std::string Finish();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// Whether WriteFile waits for the disk before it renames, so that a machine that stops then leaves
/// the old file or the new one, never an empty one. That takes 3 ms a file (measured on ext4, a
/// virtual disk): in a batch of 500 of the smallest plans 3 s, beside 14 s of computing. The folder
/// is not waited for: that would take as long again, and an old file is no harm.
enum class Durability { kSynced, kCached };

/// Writes a file as a whole: bytes go into a new file aside, which is renamed into place, so that
/// a reader never sees half of it and a failure leaves what was there.
///
/// Links are followed; the file that they end at is replaced, or made where it is missing. Mode and
/// owner of a replaced file stay (the owner as far as the process may), a new one has those of any
/// new file. A path that is neither a file nor free (a terminal, a pipe, /dev/null) is not replaced
/// but written to, and one that stands for a descriptor of this process (/dev/stdout, /dev/fd/3)
/// is that descriptor, at its place.
///
/// SIGINT, SIGTERM and SIGHUP wait while a file stands aside: only SIGKILL leaves one.
/// @throws EnvironmentError  the file cannot be written: its folder does not exist, is full or is
///                           not open to this process; it is write-protected, a folder or a disk.
void WriteFile(const std::filesystem::path& path, std::string_view bytes,
               Durability durability = Durability::kSynced);

/// Writes all of the bytes to an open file, whatever interrupts.
/// @throws std::system_error  it takes no more.
void WriteAll(int descriptor, std::string_view bytes);

/// Finds out whether WriteFile could write there now, and leaves everything as it is.
/// @throws EnvironmentError  as WriteFile.
void CheckWritable(const std::filesystem::path& path);

/// Finds out whether files could be written into a folder now or, where it does not exist, whether
/// it could be made with the folders above it; leaves everything as it is.
/// @throws EnvironmentError  they could not, or it is no folder.
void CheckFolderWritable(const std::filesystem::path& folder);

/// What WriteFile(path) replaces or makes: the end of the path's links, whether it exists or not.
/// `path` itself where that cannot be told.
[[nodiscard]] std::filesystem::path EndOfLinks(const std::filesystem::path& path);

/// The name of the file that WriteFile was writing when it left this one aside, killed before it
/// could rename it; empty where `name` is not of such a file. Of a name near the file system's
/// limit it is the beginning.
[[nodiscard]] std::string NameBesideAside(const std::string& name);

}  // namespace regrasp
