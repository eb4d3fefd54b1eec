#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "planner/base/file.h"
#include "planner/mujoco/handles.h"
#include "sim/actuation/hand_scene_export.h"

namespace regrasp::sim {

/// Load an exported scene with the MuJoCo loader. @param folder  folder for its files.
/// @throws std::runtime_error  if it cannot be loaded; with the message of MuJoCo.
inline mujoco::ModelPtr LoadStockScene(const std::vector<SceneFile>& files,
                                       const std::filesystem::path& folder) {
  for (const SceneFile& file : files) WriteFile(folder / file.name, file.bytes);
  std::array<char, 1000> error{};
  mujoco::ModelPtr model(mj_loadXML((folder / kSceneName).c_str(), nullptr, error.data(),
                                    static_cast<int>(error.size())));
  if (!model) throw std::runtime_error(error.data());
  return model;
}

}  // namespace regrasp::sim
