#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Read the bytes of a COLLADA or FBX file with assimp in this process.
///
/// Call it only in a process that may crash: see ReadWithAssimp. Coordinates are those of the file;
/// its upward axis is ignored. No file is opened. Files that do not affect the surface (materials,
/// textures, animations) are reported to assimp as missing.
/// @param file  file name without folders; assimp selects a reader by its extension, .dae or .fbx.
/// @throws InputError  if assimp would misread the file or rejects it, an index is out of range, or
///     the surface may depend on another file; the text does not contain the file's name.
[[nodiscard]] PolygonSoup ReadAssimpScene(std::string_view bytes, const std::string& file);

/// Resource limits of the child process that runs assimp.
struct AssimpLimits {
  std::size_t memory_bytes = std::size_t{4} << 30;  ///< limit of the address space
  std::chrono::seconds processor{20};
  std::chrono::milliseconds wall{30'000};
};

/// Read a file of a complex format in a child process.
///
/// The formats are glTF (ReadGltf), 3MF (Read3mf), COLLADA and FBX (ReadAssimpScene); all others
/// are rejected (FormatOf). assimp 5.2 crashes, hangs or exhausts memory on some hostile files. The
/// child process therefore has limits of memory, processor time and wall time, and its result is
/// checked. assimp only imports the scene: nodes place their meshes, points and lines are dropped.
/// It stores coordinates of COLLADA and FBX as 32-bit floats. The child opens no file, so the
/// surface depends on the bytes only.
/// @param bytes  contents of the file.
/// @param path  path of the file; its extension determines the format, and messages name it.
/// @throws InputError  if the file cannot be read, exceeds the limits, or its surface depends on
///     other files.
/// @throws EnvironmentError  if no child process can be started.
[[nodiscard]] PolygonSoup ReadWithAssimp(std::string_view bytes, const std::filesystem::path& path,
                                         const AssimpLimits& limits = {});

}  // namespace regrasp::object
