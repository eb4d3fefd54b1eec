#pragma once

#include <filesystem>

#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// Prepare a URDF model for MuJoCo.
/// Adds a `<compiler>` that keeps visual geoms and links fixed to other links, keeps the folders of
/// mesh paths, and accepts inertias that no rigid body has. Settings in the file take precedence.
///
/// MuJoCo identifies meshes by their file name without folders. Meshes with the same file name in
/// different folders, or with different scales, therefore get aliases (MeshFile). Paths such as
/// package://hand/meshes/x.stl are resolved next to the model and in the folders above it. Visual
/// meshes in formats that MuJoCo does not read, or with missing or empty files, are removed and
/// listed. MuJoCo ignores `<mimic>` and the attribute `effort` of joints; they become
/// ModelText::mimics and `ModelText::efforts`.
/// @throws InputError  if a collision mesh cannot be read, a value of `<mimic>` or an `effort` is
///     not a number, an `effort` is negative, or the model has a `<loop_joint>`.
void ConvertUrdf(const std::filesystem::path& folder, ModelText& text);

/// Remove all visual geoms, for models whose visual geoms MuJoCo rejects.
/// @param why  reason, for the list of conversions.
void DiscardVisuals(const std::string& why, ModelText& text);

}  // namespace regrasp::kinematics
