#pragma once

#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

/// Digest context of OpenSSL.
struct evp_md_ctx_st;

namespace regrasp {

/// File descriptor that is closed on destruction.
class Descriptor {
 public:
  /// @param number  file descriptor; negative: none.
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
  /// Return the descriptor and release ownership without closing it.
  [[nodiscard]] int Release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

/// Return the bytes as lower-case hexadecimal digits, two per byte.
[[nodiscard]] std::string Hexadecimal(std::string_view bytes);

/// Return the suffix of a file name in lower case: ".csv"; empty if there is none.
[[nodiscard]] std::string LowerSuffix(const std::filesystem::path& file);

/// Return the contents of a file.
/// @throws InputError  if the file does not exist, is a folder, cannot be read, or is larger than
///     `kMaxInputBytes`.
[[nodiscard]] std::string ReadFile(const std::filesystem::path& path);

/// Largest accepted size of input files.
/// It is far above any usable mesh, and far below the memory of a small machine.
inline constexpr std::size_t kMaxInputBytes = std::size_t{1} << 30;

/// Return the SHA-256 digest of `bytes` as 64 lower-case hexadecimal digits.
/// @throws EnvironmentError  if OpenSSL does not provide it.
[[nodiscard]] std::string Sha256(std::string_view bytes);

/// Incremental SHA-256 digest. The result does not depend on how the bytes are split.
class Sha256Sum {
 public:
  /// @throws EnvironmentError  if OpenSSL does not provide it.
  Sha256Sum();
  void Add(std::string_view bytes);
  /// Return the digest of all added bytes. Must be called only once.
  [[nodiscard]] std::string Finish();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// Whether WriteFile flushes the file to disk before it is renamed.
/// After a system crash a flushed file is either the old or the new one, never empty. Flushing
/// takes 3 ms per file (measured on ext4, a virtual disk): 3 s for a batch of 500 of the smallest
/// plans, in addition to 14 s of computation. The folder is not flushed, because that would take
/// the same time again and an old file is harmless.
enum class Durability { kSynced, kCached };

/// Write a file atomically.
/// The bytes go to a temporary file in the same folder, which is then renamed. A reader never sees
/// a partial file, and a failure keeps the old file.
///
/// Symbolic links are followed: their target is replaced or created. A replaced file keeps its
/// mode, and its owner if permitted. A new file gets the default mode and owner. Special files (a
/// terminal, a pipe, /dev/null) are not replaced but written to. A path of a descriptor of this
/// process (/dev/stdout, /dev/fd/3) is written at the descriptor's position.
///
/// SIGINT, SIGTERM and SIGHUP are blocked while the temporary file exists, so only SIGKILL leaves
/// it behind.
/// @throws EnvironmentError  if the file cannot be written: its folder is missing, full or not
///     accessible, or the path is write-protected, a folder or a block device.
void WriteFile(const std::filesystem::path& path, std::string_view bytes,
               Durability durability = Durability::kSynced);

/// Write all bytes to an open file, and continue after interrupts.
/// @throws std::system_error  if the write fails.
void WriteAll(int descriptor, std::string_view bytes);

/// Check that WriteFile could write a file, without any change.
/// @throws EnvironmentError  as WriteFile.
void CheckWritable(const std::filesystem::path& path);

/// Check that files could be written to a folder, without any change.
/// If the folder does not exist, check that it could be created together with its parents.
/// @throws EnvironmentError  if not, or if the path is not a folder.
void CheckFolderWritable(const std::filesystem::path& folder);

/// Return the file that WriteFile(path) replaces or creates.
/// It is the target of the path's links, even if it does not exist.
/// Returns `path` if that cannot be determined.
[[nodiscard]] std::filesystem::path EndOfLinks(const std::filesystem::path& path);

/// Return the file name to which a temporary file of WriteFile belongs.
/// WriteFile leaves such a file behind after SIGKILL.
/// @returns empty if `name` is not the name of such a file. A name near the length limit of the
///     file system is truncated.
[[nodiscard]] std::string NameBesideAside(const std::string& name);

/// Return the text of a file without its UTF-8 byte-order mark.
///
/// Every reader of text calls this function first, so that all of them accept the same files.
/// UTF-16 and UTF-32 are detected by their byte-order mark, or by the zero bytes in their first two
/// characters. Other bytes that are not UTF-8 are accepted here, because comments and names in
/// surface files can have any 8-bit encoding.
/// @param bytes  bytes of the file, or of its first line; must outlive the result.
/// @param name   name of the file in messages.
/// @returns the bytes after the mark.
/// @throws InputError  if the text is in UTF-16 or UTF-32.
[[nodiscard]] std::string_view TextOf(std::string_view bytes, const std::string& name);

}  // namespace regrasp
