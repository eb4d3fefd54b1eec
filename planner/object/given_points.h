#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <vector>

#include "planner/object/reading.h"

namespace regrasp::object {

/// A contact this close, over the diameter, to a point that the object's file gives is at it: a
/// tenth of a millimetre on what is 10 cm across. A given point is a corner of several facets,
/// where a contact has no normal; beside it on one of them it has.
inline constexpr double kAtGivenPoint = 1e-3;

/// The points that a file gives: those of a cloud, the vertices of a surface.
/// @throws InputError  it cannot be read, or holds a polygon.
/// @throws TimeUp  the deadline came.
[[nodiscard]] std::vector<Eigen::Vector3d> ReadGivenPoints(const std::filesystem::path& path,
                                                           const Reading& reading);

/// The one of some points that is nearest to a place. @pre there is one.
[[nodiscard]] const Eigen::Vector3d& NearestPoint(std::span<const Eigen::Vector3d> points,
                                                  const Eigen::Vector3d& place);

}  // namespace regrasp::object
