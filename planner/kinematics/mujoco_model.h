#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "planner/kinematics/model_text.h"
#include "planner/mujoco/handles.h"

namespace regrasp::kinematics {

/// What an element of MJCF may have, as the MuJoCo that is linked here says of itself.
struct SchemaElement {
  std::set<std::string, std::less<>> attributes;
  std::map<std::string, SchemaElement, std::less<>> children;
  bool recursive = false;  ///< it may contain itself

  /// @returns nullptr where it may have no such child.
  [[nodiscard]] const SchemaElement* Child(const std::string& parent,
                                           const std::string& child) const;
};

/// The element <mujoco>, from mj_printSchema.
[[nodiscard]] const SchemaElement& MujocoSchema();

using mujoco::DataPtr;
using mujoco::ModelPtr;

struct CompiledModel {
  ModelPtr model;
  ModelText text;  ///< of which it was compiled
};

/// Compiles an MJCF or URDF model with the meshes that it names, converted to what the linked
/// MuJoCo knows (model_text.h). That is done in a limited child process: whatever is in the files,
/// this one goes on.
/// @throws InputError  names the file and says what is wrong, or what MuJoCo says of it.
[[nodiscard]] CompiledModel CompileModel(const std::filesystem::path& path);

/// Compiles a text, in a limited child process.
/// @param path  of the model that the text was read from: meshes are looked for beside it.
/// @throws InputError  what MuJoCo says against it.
[[nodiscard]] ModelPtr CompileText(const std::filesystem::path& path, const ModelText& text);

/// A text as MJCF, whatever it is: what MuJoCo made of it, in a limited child process.
/// @throws InputError  what MuJoCo says against it.
[[nodiscard]] ModelText AsMjcf(const std::filesystem::path& path, const ModelText& text);

/// Bodies, geoms and joints as the model has them at rest (qpos0), in world coordinates.
[[nodiscard]] DataPtr AtRest(const mjModel& model);

}  // namespace regrasp::kinematics
