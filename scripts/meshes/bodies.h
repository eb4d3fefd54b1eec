#pragma once

#include <string>
#include <vector>

#include "solid_field.h"

namespace regrasp_meshes {

/// A smooth body, in metres.
struct Body {
  std::string name;
  std::string description;  ///< what the file's first line says
  Field field;
  Point inside;  ///< a point well inside
};

/// The bodies that are modelled.
std::vector<Body> AllBodies();

}  // namespace regrasp_meshes
