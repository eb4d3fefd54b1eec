#pragma once

#include <filesystem>
#include <string>

#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// Return why a file cannot be read as a mesh; empty if it has bytes.
[[nodiscard]] std::string WhyMeshIsMissing(const std::filesystem::path& path);

/// Where an MJCF model has its meshes.
struct MeshPaths {
  std::filesystem::path folder;
  bool strips_path = false;  ///< the folder of a file's name does not count

  [[nodiscard]] std::filesystem::path PathOf(const std::string& file) const {
    const std::filesystem::path path(file);
    return folder / (strips_path ? path.filename() : path);
  }
};

/// Leave out the meshes of an MJCF model whose files are missing or empty, with the geoms that only
/// show them: geoms that neither collide nor have a mass. Each is listed as a conversion.
/// @throws InputError  a geom that collides, or that gives its body mass, has such a mesh. Names
/// the
///                     line and the file.
void DropMissingLooks(const MeshPaths& paths, ModelText& text);

}  // namespace regrasp::kinematics
