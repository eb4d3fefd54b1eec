#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Reads the bytes of a COLLADA or FBX file with assimp in this process. Only for a process that
/// may be lost: see ReadWithAssimp.
///
/// Coordinates are those of the file, whatever it names as the upward axis.
/// No file is opened. Files that make no difference to the surface (materials, textures,
/// animations) are told to be missing.
/// @param file  the file's name without folders; assimp chooses a reader by its ending, .dae or
/// .fbx.
/// @throws InputError  it holds what assimp would misread, assimp refuses it, its indices point
/// nowhere, or it asks for another file that
///                     the surface may come from; without the file's name.
[[nodiscard]] PolygonSoup ReadAssimpScene(std::string_view bytes, const std::string& file);

/// What the child process that runs assimp may use.
struct AssimpLimits {
  std::size_t memory_bytes = std::size_t{4} << 30;  ///< of address space
  std::chrono::seconds processor{20};
  std::chrono::milliseconds wall{30'000};
};

/// Reads the bytes of a format that takes a complex reader in a child process: glTF (ReadGltf), 3MF
/// (Read3mf), COLLADA and FBX (ReadAssimpScene). Other formats are refused (FormatOf).
///
/// assimp 5.2 crashes, hangs or exhausts memory on some hostile files: the child has limits of
/// memory, processor and wall time, and what it sends back is checked. It is asked for nothing but
/// the scene: meshes are placed by their nodes, points and lines are dropped. Coordinates of
/// COLLADA and FBX are 32-bit floats there. The child opens no file: the surface is that of the
/// bytes.
/// @param path  where they come from: its ending tells the format, and messages name it.
/// @throws InputError  the file cannot be read by assimp, or not within the limits, or its surface
///                     comes from other files.
/// @throws EnvironmentError  no process can be started.
[[nodiscard]] PolygonSoup ReadWithAssimp(std::string_view bytes, const std::filesystem::path& path,
                                         const AssimpLimits& limits = {});

}  // namespace regrasp::object
