#pragma once

#include <stdexcept>
#include <string>

namespace regrasp {

/// Bad usage or bad input: a program that catches it prints `what()` as one line and exits with 2.
///
/// The message names the file, the element and the value: "cube.obj: facet 12: vertex index 99 is
/// out of range (8 vertices)".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The environment failed (no rendering context, a folder that cannot be written): exit code 3.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace regrasp
