#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <vector>

#include "planner/object/reading.h"

namespace regrasp::object {

/// Largest distance of a contact from a point of the file, divided by the diameter, to count as on
/// it.
///
/// It is 0.1 mm for an object of 10 cm. A point of the file is a corner of several triangles, so a
/// contact has no normal there. A contact next to it, on one of the triangles, has.
inline constexpr double kAtGivenPoint = 1e-3;

/// Read the points of a file: those of a point cloud, or the vertices of a surface.
/// @throws InputError  if the file cannot be read or is a WKT polygon.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] std::vector<Eigen::Vector3d> ReadGivenPoints(const std::filesystem::path& path,
                                                           const Reading& reading);

/// Return the point nearest to `place`. @pre `points` is not empty.
[[nodiscard]] const Eigen::Vector3d& NearestPoint(std::span<const Eigen::Vector3d> points,
                                                  const Eigen::Vector3d& place);

}  // namespace regrasp::object
