#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "planner/object/object.h"
#include "planner/object/polyhedron.h"

namespace regrasp::object {

/// Compute the largest distance between two of the points; 0 for fewer than two points.
///
/// Exact up to the rounding of one distance. The time is O(n log n) in practice: a k-d tree finds
/// the farthest point, for each point that can be an end of the diameter. Laws: independent of the
/// order; scales with the points.
[[nodiscard]] double ComputeDiameter(std::span<const Eigen::Vector3d> points);

/// Measure the smallest distance between two parallel planes that enclose a solid, in its units.
///
/// Tests the normals of all planar faces and further directions. The result is therefore an upper
/// bound, and exact if one of the planes contains a face. Laws: at most the diameter; scales with
/// the solid.
[[nodiscard]] double MeasureWidth(const Polyhedron& solid);

/// Size and mass of an object.
struct BodyMeasures {
  double diameter_m = 0;
  double thickness_m = 0;  ///< thickness of the prism of a polygon; 0 for a solid
  double mass_kg = 0;
};

inline constexpr double kUsualDensity = 1000;    ///< density of water, kg/m³
inline constexpr double kPrismThickness = 0.25;  ///< thickness of a polygon's prism divided by D

/// Range of usual object sizes, m. Outside of it, the unit of length is probably wrong.
inline constexpr double kSmallestUsual = 0.002;
inline constexpr double kLargestUsual = 2;

/// Compute the size and mass of an object.
/// @param scale  metres per unit of length of the object.
/// @param thickness  thickness of the prism of a polygon, in units of the object. Default:
///     kPrismThickness · D.
[[nodiscard]] BodyMeasures MeasureBody(const Object& object, double scale,
                                       double density_kg_m3 = kUsualDensity,
                                       std::optional<double> thickness = std::nullopt);

/// Return size and mass as text: "10.4 cm across, 216 g".
[[nodiscard]] std::string MeasuresText(const BodyMeasures& body);

/// Return the unit of an object's file as a suffix of its size.
///
/// Example: "; its file is in inches, read as metres".
/// @param unit  unit of the file (ObjectFile::unit); empty if the file has none. The text is then
///     empty, too.
[[nodiscard]] std::string UnitText(const std::string& unit);

/// Return a warning about an object below kSmallestUsual or above kLargestUsual; otherwise "".
///
/// The text suggests a unit of length in which the object is 2 to 40 cm across: "millimetres? use
/// --scale 0.001".
/// @param scale  metres per unit of length of the object, as passed to MeasureBody.
[[nodiscard]] std::string SizeWarning(const BodyMeasures& body, double scale);

}  // namespace regrasp::object
