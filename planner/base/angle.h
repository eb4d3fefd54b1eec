#pragma once

#include <numbers>

namespace regrasp {

/// Angles are radians everywhere inside the library, degrees in files and on the command line.
[[nodiscard]] constexpr double Radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
[[nodiscard]] constexpr double Degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

}  // namespace regrasp
