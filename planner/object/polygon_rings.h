#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp::object {

/// Rings of a polygon, the outer one first; a ring's last point is not repeated.
using PolygonRings = std::vector<std::vector<Eigen::Vector2d>>;

/// Checks that rings bound one connected sheet and turns the outer one counter-clockwise and holes
/// clockwise (their first points stay first). As Polygon::FromRings says.
/// @throws InputError
void CheckAndOrientRings(PolygonRings& rings, const std::string& name);

/// The rings of a WKT POLYGON or a MULTIPOLYGON of one polygon, unchecked. As Polygon::FromWkt
/// says.
/// @throws InputError
[[nodiscard]] PolygonRings ReadWktRings(std::string_view text, const std::string& name);

}  // namespace regrasp::object
