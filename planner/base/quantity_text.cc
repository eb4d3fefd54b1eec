#include "planner/base/quantity_text.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "planner/base/length_unit.h"
#include "planner/base/number.h"

namespace regrasp {

namespace {

constexpr int kAngleDecimals = 2;

constexpr LengthUnit kLengths[] = {{1e3, "km"},  {1, "m"},     {1e-2, "cm"},
                                   {1e-3, "mm"}, {1e-6, "µm"}, {1e-9, "nm"}};

struct MassUnit {
  double kg;
  const char* name;
};
constexpr MassUnit kMasses[] = {{1, "kg"}, {1e-3, "g"}, {1e-6, "mg"}, {1e-9, "µg"}};

/// The largest unit of which there is one once the value is rounded, otherwise the last.
template <class Unit>
Unit UnitOf(double value, int digits, std::span<const Unit> units, double Unit::*size) {
  const double one = 1 - std::pow(10.0, -digits) / 2;
  const auto fits =
      std::ranges::find_if(units, [&](const Unit& unit) { return value / unit.*size >= one; });
  return fits == units.end() ? units.back() : *fits;
}

}  // namespace

LengthUnit UnitOfLength(double metres, int digits) {
  return UnitOf<LengthUnit>(metres, digits, kLengths, &LengthUnit::metres);
}

std::string FormatPlain(double value, int digits) {
  constexpr double kLargest = 1e6;
  // What rounds up to one more digit has it already.
  if (!(std::abs(value) >= std::pow(10.0, digits) - 0.5) || std::abs(value) >= kLargest) {
    return FormatShort(value, digits);
  }
  const double place = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
  return FormatFixed(std::round(value / place) * place, 0);
}

std::string FormatLength(double metres, int digits) {
  const LengthUnit unit = UnitOfLength(metres, digits);
  return FormatPlain(metres / unit.metres, digits) + " " + unit.name;
}

std::string FormatMass(double kg, int digits) {
  const MassUnit unit = UnitOf<MassUnit>(kg, digits, kMasses, &MassUnit::kg);
  return FormatPlain(kg / unit.kg, digits) + " " + unit.name;
}

std::string FormatDegrees(double degrees) { return FormatFixed(degrees, kAngleDecimals) + "°"; }

}  // namespace regrasp
