#pragma once

#include <filesystem>
#include <string>

#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// Return why a file cannot be read as a mesh; empty if it is a file with contents.
[[nodiscard]] std::string WhyMeshIsMissing(const std::filesystem::path& path);

/// Location of the meshes of an MJCF model.
struct MeshPaths {
  std::filesystem::path folder;
  bool strips_path = false;  ///< whether folders in a mesh's file name are ignored

  [[nodiscard]] std::filesystem::path PathOf(const std::string& file) const {
    const std::filesystem::path path(file);
    return folder / (strips_path ? path.filename() : path);
  }
};

/// Remove missing or empty meshes from an MJCF model, together with the geoms that only show them.
/// These geoms neither collide nor have mass. Each removed geom is listed as a conversion.
/// @throws InputError  if a geom with such a mesh collides or has mass. The message names the line
///     and the file.
void DropMissingVisuals(const MeshPaths& paths, ModelText& text);

}  // namespace regrasp::kinematics
