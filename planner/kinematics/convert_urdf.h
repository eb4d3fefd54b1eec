#pragma once

#include <filesystem>

#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// Prepares a URDF for MuJoCo: a <compiler> that keeps what links look like, keeps links that are
/// fixed to others, finds meshes in folders and takes inertias that no body has. Where it says
/// something of these settings already, that stays.
///
/// MuJoCo knows meshes by the last part of their paths: those of the same name in other folders, or
/// in another scale, get names of their own (MeshFile). Paths like package://hand/meshes/x.stl are
/// looked for beside the model and in the folders above it. Looks in formats that MuJoCo does not
/// read are left out. <mimic>, which it passes over, becomes ModelText::mimics.
/// @throws InputError  the shape that a link collides with is in such a format.
void ConvertUrdf(const std::filesystem::path& folder, ModelText& text);

/// The same without looks, for models whose looks MuJoCo does not take.
void DiscardLooks(const std::string& why, ModelText& text);

}  // namespace regrasp::kinematics
