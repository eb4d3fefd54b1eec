#include "planner/plan/off_surface.h"

#include <optional>

#include "planner/base/number.h"

namespace regrasp::plan {

namespace {

/// Each look for faces is this much wider than the one before, so that a mesh's far faces are not
/// looked at for a point that is near.
constexpr double kWider = 10;

std::optional<double> DistanceToSurface(const object::Object& object,
                                        const Eigen::Vector3d& point) {
  for (double share = object::kPointTolerance; share <= kFarthestTold; share *= kWider) {
    const auto faces = object.FacesNear(point, share * object.diameter());
    if (!faces.empty()) return (object.ClosestPoint(faces.front(), point) - point).norm();
  }
  return std::nullopt;
}

}  // namespace

std::string OffSurfaceText(const object::Object& object, const Eigen::Vector3d& point) {
  const auto distance = DistanceToSurface(object, point);
  const std::string off =
      distance ? FormatShort(*distance) + " of the object file's units off the surface, " +
                     FormatShort(*distance / object.diameter()) + " of the object's diameter"
               : "more than " + FormatShort(kFarthestTold) +
                     " of the object's diameters off the surface";
  return off + "; up to " + FormatShort(object::kPointTolerance) + " of it counts as on it";
}

}  // namespace regrasp::plan
