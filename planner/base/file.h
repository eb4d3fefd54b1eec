#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace regrasp {

/// The bytes of a file.
/// @throws InputError  the file does not exist, is a folder, cannot be read, or is larger than
///                     `kMaxInputBytes`.
[[nodiscard]] std::string ReadFile(const std::filesystem::path& path);

/// Input files larger than this are refused: far above any mesh that can be planned on, far below
/// the memory of a small machine.
inline constexpr std::size_t kMaxInputBytes = std::size_t{1} << 30;

/// Writes a file aside and renames it into place, so that a reader never sees half of it.
/// @throws EnvironmentError  the folder does not exist or cannot be written.
void WriteFile(const std::filesystem::path& path, std::string_view bytes);

/// The name of the file that WriteFile was writing when it left this one aside, killed before it
/// could rename it; empty where `name` is not of such a file.
[[nodiscard]] std::string NameBesideAside(const std::string& name);

/// The SHA-256 digest of `bytes`, 64 lower-case hexadecimal digits.
[[nodiscard]] std::string Sha256(std::string_view bytes);

}  // namespace regrasp
