#include "planner/object/body_measures.h"

#include <algorithm>
#include <array>

#include "planner/base/number.h"
#include "planner/base/quantity_text.h"

namespace regrasp::object {

namespace {

struct LengthUnit {
  const char* name;
  double metres;
};

/// What files are usually in, the likeliest first.
constexpr std::array<LengthUnit, 4> kUnits = {
    {{"millimetres", 0.001}, {"centimetres", 0.01}, {"inches", 0.0254}, {"metres", 1}}};

/// What hands grasp is mostly this wide, metres.
constexpr double kSmallestGuess = 0.02, kLargestGuess = 0.4;

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
  const std::string thick = body.thickness_m > 0 ? FormatLength(body.thickness_m) + " thick, " : "";
  return FormatLength(body.diameter_m) + " across, " + thick + FormatMass(body.mass_kg);
}

std::string UnitText(const std::string& unit) {
  if (unit.empty()) return "";
  return "; its file is in " + unit + (unit == "metres" ? "" : ", read as metres");
}

std::string SizeWarning(const BodyMeasures& body, double scale) {
  if (body.diameter_m >= kSmallestUsual && body.diameter_m <= kLargestUsual) return "";
  const double units = body.diameter_m / scale;
  const auto unit = std::ranges::find_if(kUnits, [&](const LengthUnit& guess) {
    return units * guess.metres >= kSmallestGuess && units * guess.metres <= kLargestGuess;
  });
  const std::string size = "the object is " + MeasuresText(body) + ": ";
  if (unit == kUnits.end()) {
    return size +
           "is that meant? --scale says how many metres a unit of length of its file is, 0.001 for "
           "millimetres";
  }
  return size + unit->name + "? use --scale " + FormatShort(unit->metres) + " (" +
         FormatLength(units * unit->metres) + " across)";
}

}  // namespace regrasp::object
