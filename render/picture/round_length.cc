#include "render/picture/round_length.h"

#include <array>
#include <cmath>

#include "planner/base/number.h"

namespace regrasp::render {

double RoundLength(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit) return digit * power;
  }
  return power;
}

std::string FormatLength(double metres, int digits) {
  struct Unit {
    double metres;
    const char* name;
  };
  static constexpr std::array<Unit, 6> kUnits = {
      {{1e3, " km"}, {1, " m"}, {1e-2, " cm"}, {1e-3, " mm"}, {1e-6, " µm"}, {1e-9, " nm"}}};
  // A hair below one: 0.01 / 1e-2 may round down.
  constexpr double kOne = 1 - 1e-9;
  for (const auto& [size, name] : kUnits) {
    if (metres / size >= kOne) return FormatShort(metres / size, digits) + name;
  }
  return FormatShort(metres, digits) + " m";
}

}  // namespace regrasp::render
