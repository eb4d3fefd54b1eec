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

/// Schema of an MJCF element in the linked MuJoCo version.
struct SchemaElement {
  std::set<std::string, std::less<>> attributes;
  std::map<std::string, SchemaElement, std::less<>> children;
  bool recursive = false;  ///< whether it can contain itself

  /// Return the schema of a child; nullptr if the element cannot have it.
  [[nodiscard]] const SchemaElement* Child(const std::string& parent,
                                           const std::string& child) const;
};

/// Return the schema of the element `<mujoco>`, from mj_printSchema.
[[nodiscard]] const SchemaElement& MujocoSchema();

using mujoco::DataPtr;
using mujoco::ModelPtr;

struct CompiledModel {
  ModelPtr model;
  ModelText text;   ///< compiled text
  XmlElement mjcf;  ///< MuJoCo's conversion of a URDF text to MJCF; empty for other models
};

/// Return the compiled text of a model; of a URDF model its conversion to MJCF.
[[nodiscard]] ModelText MjcfOf(const CompiledModel& compiled);

/// Compile an MJCF or URDF model with its meshes.
/// The model is converted to the linked MuJoCo version (model_text.h).
/// MuJoCo runs in a limited child process, so that no model can crash the caller.
/// @throws InputError  if the model is invalid. The message names the file and has MuJoCo's reason.
[[nodiscard]] CompiledModel CompileModel(const std::filesystem::path& path);

/// Compile a model text in a limited child process.
/// @param path  file that the text was read from; meshes are relative to it.
/// @throws InputError  if MuJoCo rejects it.
[[nodiscard]] ModelPtr CompileText(const std::filesystem::path& path, const ModelText& text);

/// Convert a model text to MJCF, by MuJoCo in a limited child process.
/// @throws InputError  if MuJoCo rejects it.
[[nodiscard]] ModelText AsMjcf(const std::filesystem::path& path, const ModelText& text);

/// Compute positions in the reference configuration (qpos0), in world coordinates.
[[nodiscard]] DataPtr AtRest(const mjModel& model);

}  // namespace regrasp::kinematics
