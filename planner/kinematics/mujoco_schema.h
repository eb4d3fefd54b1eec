#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

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

}  // namespace regrasp::kinematics
