#pragma once

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <filesystem>
#include <string>

#include "planner/base/file.h"
#include "planner/mujoco/handles.h"

namespace regrasp::sim {

using mujoco::DataPtr;
using mujoco::ModelPtr;

/// Write the scene to a file and load it like a MuJoCo user.
inline ModelPtr LoadFromFile(const std::string& mjcf) {
  const auto path =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".xml");
  WriteFile(path, mjcf);
  std::array<char, 1000> error{};
  ModelPtr model(mj_loadXML(path.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  EXPECT_NE(model, nullptr) << error.data();
  std::filesystem::remove(path);
  return model;
}

}  // namespace regrasp::sim
