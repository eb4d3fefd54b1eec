#pragma once

#include <filesystem>
#include <string_view>

namespace regrasp::object {

/// Format of surfaces or point clouds that is read in accordance with its specification.
enum class SurfaceFormat { kObj, kOff, kPly, kStl, kXyz, kPcd, k3mf, kGltf, kCollada, kFbx };

/// Determine the format of a file.
///
/// The extension of the file name determines it. For a name without extension, such as that of a
/// pipe, the first bytes do. Every other format is rejected, although assimp reads about forty
/// more. assimp swaps the axes of some (3DS, ASE, DXF), mirrors others (X) and ignores units (AMF,
/// X3D).
/// @param path   name of the file.
/// @param bytes  its contents.
/// @throws InputError  if the format is not supported; names file, extension and supported
///     extensions.
[[nodiscard]] SurfaceFormat FormatOf(const std::filesystem::path& path, std::string_view bytes);

}  // namespace regrasp::object
