#pragma once

#include <filesystem>
#include <string_view>

namespace regrasp::object {

/// A format of surfaces or clouds of points that is read as its specification states.
enum class SurfaceFormat { kObj, kOff, kPly, kStl, kXyz, kPcd, k3mf, kGltf, kCollada, kFbx };

/// Determine the format of a file: by the ending of its name, or for a name without one, such as
/// that of a pipe, by its first bytes.
///
/// Every other format is refused, although assimp reads about forty more: it turns the axes of some
/// (3DS, ASE, DXF), mirrors others (X) and ignores units (AMF, X3D).
/// @param path   name of the file.
/// @param bytes  its contents.
/// @throws InputError  if the format is not supported; names file, ending and supported endings.
[[nodiscard]] SurfaceFormat FormatOf(const std::filesystem::path& path, std::string_view bytes);

}  // namespace regrasp::object
