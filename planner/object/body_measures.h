#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "planner/object/object.h"

namespace regrasp::object {

/// The largest distance between two of the points; 0 for fewer than two.
///
/// Exact up to the rounding of one distance. n log n in practice: a k-d tree finds the farthest
/// point of each that is far enough out to be an end. Laws: independent of the order; scales with
/// the points.
[[nodiscard]] double ComputeDiameter(std::span<const Eigen::Vector3d> points);

/// How large and heavy an object is.
struct BodyMeasures {
  double diameter_m = 0;
  double thickness_m = 0;  ///< of the prism that a planar object is; 0 for a solid
  double mass_kg = 0;
};

inline constexpr double kUsualDensity = 1000;    ///< kg/m³, water's
inline constexpr double kPrismThickness = 0.25;  ///< over D, of a polygon's prism

/// Beyond these, metres, hands grasp little: a unit of length was probably taken for another.
inline constexpr double kSmallestUsual = 0.002;
inline constexpr double kLargestUsual = 2;

/// @param scale      metres per unit of the object.
/// @param thickness  of the prism, the object's own unit; kPrismThickness · D where left out.
[[nodiscard]] BodyMeasures MeasureBody(const Object& object, double scale,
                                       double density_kg_m3 = kUsualDensity,
                                       std::optional<double> thickness = std::nullopt);

/// "10.4 cm across, 216 g".
[[nodiscard]] std::string MeasuresText(const BodyMeasures& body);

/// What an object's file says of its unit (ObjectFile::unit), to stand behind its size: "; its file
/// is in inches, read as metres"; empty where it says nothing.
[[nodiscard]] std::string UnitText(const std::string& unit);

/// Of a body below kSmallestUsual or above kLargestUsual, what to look at; otherwise empty. A unit
/// of length in which it is 2 to 40 cm across is guessed: "millimetres? use --scale 0.001".
/// @param scale  metres per unit of the object, as the body was measured with.
[[nodiscard]] std::string SizeWarning(const BodyMeasures& body, double scale);

}  // namespace regrasp::object
