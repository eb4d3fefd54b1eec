#pragma once

#include <string>
#include <vector>

#include "sim/actuation/hand_scene_export.h"

namespace regrasp::apps {

/// Writes the scene of a hand into a folder, which is made where there is none.
/// @throws EnvironmentError  it cannot be written.
void WriteSceneFolder(const std::string& folder, const std::vector<sim::SceneFile>& files);

}  // namespace regrasp::apps
