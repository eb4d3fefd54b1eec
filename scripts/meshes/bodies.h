#pragma once

#include <string>
#include <vector>

#include "solid_field.h"

namespace regrasp_meshes {

/// Smooth solid, in metres.
struct Body {
  std::string name;
  std::string description;  ///< first line of the file
  Field field;
  Point inside;  ///< point well inside
};

/// Return all modelled solids.
std::vector<Body> AllBodies();

}  // namespace regrasp_meshes
