#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "planner/base/write_file.h"  // IWYU pragma: export

namespace regrasp {

/// The bytes of a file.
/// @throws InputError  the file does not exist, is a folder, cannot be read, or is larger than
///                     `kMaxInputBytes`.
[[nodiscard]] std::string ReadFile(const std::filesystem::path& path);

/// Input files larger than this are refused: far above any mesh that can be planned on, far below
/// the memory of a small machine.
inline constexpr std::size_t kMaxInputBytes = std::size_t{1} << 30;

/// The SHA-256 digest of `bytes`, 64 lower-case hexadecimal digits.
[[nodiscard]] std::string Sha256(std::string_view bytes);

}  // namespace regrasp
