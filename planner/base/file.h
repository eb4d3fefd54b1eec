#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "planner/base/write_file.h"  // IWYU pragma: export

/// OpenSSL's.
struct evp_md_ctx_st;

namespace regrasp {

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

}  // namespace regrasp
