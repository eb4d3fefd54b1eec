#include "planner/object/given_points.h"

#include <algorithm>

#include "planner/object/read_object.h"

namespace regrasp::object {

std::vector<Eigen::Vector3d> ReadGivenPoints(const std::filesystem::path& path,
                                             const Reading& reading) {
  return ReadSoup(path, reading).soup.vertices;
}

const Eigen::Vector3d& NearestPoint(std::span<const Eigen::Vector3d> points,
                                    const Eigen::Vector3d& place) {
  return *std::ranges::min_element(
      points, {}, [&](const Eigen::Vector3d& point) { return (point - place).squaredNorm(); });
}

}  // namespace regrasp::object
