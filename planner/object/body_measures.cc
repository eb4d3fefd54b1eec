#include "planner/object/body_measures.h"

#include <algorithm>
#include <span>

#include "planner/base/number.h"

namespace regrasp::object {

namespace {

struct Unit {
  double size;
  const char* name;
};

/// In the largest unit of which there is one, otherwise in the last.
std::string InUnits(double value, std::span<const Unit> units) {
  constexpr int kDigits = 3;
  const auto fits = std::ranges::find_if(units, [&](const Unit& u) { return value >= u.size; });
  const Unit& unit = fits == units.end() ? units.back() : *fits;
  return FormatShort(value / unit.size, kDigits) + " " + unit.name;
}

constexpr Unit kLengths[] = {{1, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "µm"}};
constexpr Unit kMasses[] = {{1, "kg"}, {1e-3, "g"}, {1e-6, "mg"}, {1e-9, "µg"}};

}  // namespace

BodyMeasures MeasureBody(const Object& object, double scale, double density_kg_m3,
                         std::optional<double> thickness) {
  BodyMeasures body;
  body.diameter_m = object.diameter() * scale;
  const bool planar = object.dimension() == 2;
  if (planar) body.thickness_m = thickness.value_or(kPrismThickness * object.diameter()) * scale;
  body.mass_kg = density_kg_m3 * object.mass_properties().volume * scale * scale *
                 (planar ? body.thickness_m : scale);
  return body;
}

std::string MeasuresText(const BodyMeasures& body) {
  const std::string thick =
      body.thickness_m > 0 ? InUnits(body.thickness_m, kLengths) + " thick, " : "";
  return InUnits(body.diameter_m, kLengths) + " across, " + thick + InUnits(body.mass_kg, kMasses);
}

std::string SizeWarning(const BodyMeasures& body) {
  if (body.diameter_m >= kSmallestUsual && body.diameter_m <= kLargestUsual) return "";
  return "the object is " + MeasuresText(body) +
         ": is that meant? --scale says how many metres a unit of length of its file is, 0.001 for "
         "millimetres";
}

}  // namespace regrasp::object
