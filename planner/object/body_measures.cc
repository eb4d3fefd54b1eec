#include "planner/object/body_measures.h"

#include "planner/base/quantity_text.h"

namespace regrasp::object {

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

std::string SizeWarning(const BodyMeasures& body) {
  if (body.diameter_m >= kSmallestUsual && body.diameter_m <= kLargestUsual) return "";
  return "the object is " + MeasuresText(body) +
         ": is that meant? --scale says how many metres a unit of length of its file is, 0.001 for "
         "millimetres";
}

}  // namespace regrasp::object
