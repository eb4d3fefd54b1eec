#pragma once

#include <stdexcept>
#include <string>

namespace regrasp {

/// Bad usage or bad input: programs print `what()` as one line and exit with code 2.
///
/// The message names the file, the element and the value: `cube.obj: facet 12: vertex index 99
/// must be at most 8, the number of vertices`.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Failure of the environment, such as no rendering context or a read-only folder: exit code 3.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace regrasp
