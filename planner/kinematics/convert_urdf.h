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
/// read, and looks whose files are missing or empty, are left out and listed. <mimic> and the
/// efforts of joints, which it passes over, become ModelText::mimics and ModelText::efforts.
/// @throws InputError  the shape that a link collides with cannot be read; a number of <mimic> or
///                     of an effort is not a number, or an effort is negative; a <loop_joint>.
void ConvertUrdf(const std::filesystem::path& folder, ModelText& text);

/// The same without looks, for models whose looks MuJoCo does not take.
void DiscardLooks(const std::string& why, ModelText& text);

}  // namespace regrasp::kinematics
