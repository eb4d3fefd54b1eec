#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>

#include "planner/object/polygon_soup.h"

namespace regrasp {

/// What the child process that runs assimp may use.
struct AssimpLimits {
  std::size_t memory_bytes = std::size_t{4} << 30;  ///< of address space
  std::chrono::seconds processor{20};
  std::chrono::milliseconds wall{30'000};
};

/// Reads any surface format that assimp knows (glTF, 3MF, COLLADA, …), in a child process.
///
/// assimp 5.2 crashes, hangs or exhausts memory on some hostile files: the child has limits of
/// memory, processor and wall time, and what it sends back is checked. It is asked for nothing but
/// the scene: meshes are placed by their nodes, points and lines are dropped. Coordinates are
/// 32-bit floats there.
/// @throws InputError  the file cannot be read by assimp, or not within the limits.
/// @throws EnvironmentError  no process can be started.
[[nodiscard]] PolygonSoup ReadWithAssimp(const std::filesystem::path& path,
                                         const AssimpLimits& limits = {});

}  // namespace regrasp
