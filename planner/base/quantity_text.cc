#include "planner/base/quantity_text.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "planner/base/number.h"

namespace regrasp {

namespace {

constexpr int kAngleDecimals = 2;

struct Unit {
  double size;
  const char* name;
};

constexpr Unit kLengths[] = {{1e3, " km"},  {1, " m"},     {1e-2, " cm"},
                             {1e-3, " mm"}, {1e-6, " µm"}, {1e-9, " nm"}};
constexpr Unit kMasses[] = {{1, " kg"}, {1e-3, " g"}, {1e-6, " mg"}, {1e-9, " µg"}};

/// In the largest unit of which there is one once the value is rounded, otherwise in the last.
std::string InUnits(double value, int digits, std::span<const Unit> units) {
  const double one = 1 - std::pow(10.0, -digits) / 2;
  const auto fits =
      std::ranges::find_if(units, [&](const Unit& u) { return value / u.size >= one; });
  const Unit& unit = fits == units.end() ? units.back() : *fits;
  return FormatShort(value / unit.size, digits) + unit.name;
}

}  // namespace

std::string FormatLength(double metres, int digits) { return InUnits(metres, digits, kLengths); }

std::string FormatMass(double kg, int digits) { return InUnits(kg, digits, kMasses); }

std::string FormatDegrees(double degrees) { return FormatFixed(degrees, kAngleDecimals) + "°"; }

}  // namespace regrasp
