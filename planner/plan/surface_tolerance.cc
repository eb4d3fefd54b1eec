#include "planner/plan/surface_tolerance.h"

#include <algorithm>
#include <limits>

#include "planner/base/number.h"
#include "planner/plan/projection.h"

namespace regrasp::plan {

double SurfaceTolerance(const object::Object& object) {
  const double diameter = object.diameter();
  const double largest = object.mass_properties().centroid.lpNorm<Eigen::Infinity>() + diameter;
  const double lost =
      kSinglePrecisionSteps * double{std::numeric_limits<float>::epsilon()} * largest;
  return std::max(object::kPointTolerance * diameter,
                  std::min(lost, kLargestPointTolerance * diameter));
}

std::string OffSurfaceText(const object::Object& object, const Eigen::Vector3d& point) {
  const double distance =
      (NearestContact(object, {point, Eigen::Vector3d::Zero()}).p - point).stableNorm();
  const double tolerance = SurfaceTolerance(object);
  const bool single = tolerance > object::kPointTolerance * object.diameter();
  return "off the surface, expected at most " + FormatShort(tolerance / object.diameter()) +
         " of the object's diameter" +
         (single ? " (the precision of float32 at this distance from the origin)" : "") +
         ", found " + FormatShort(distance / object.diameter()) + " (" + FormatShort(distance) +
         " in the object file's unit)";
}

}  // namespace regrasp::plan
