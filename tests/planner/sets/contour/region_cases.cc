#include "tests/planner/sets/contour/region_cases.h"

#include <random>

namespace regrasp::contour {
namespace {

constexpr std::uint64_t kSeed = 8;

/// Perturbation larger than rounding and smaller than the tolerance of equal places.
constexpr double kShake = 1e-13;

}  // namespace

double SizeToleranceOf(const object::Polygon& polygon) {
  constexpr double kTolerance = 1e-9;
  double length = 0;
  for (FaceIndex e{0}; e < polygon.face_count(); ++e) length += polygon.face_measure(e);
  return kTolerance * length;
}

const std::vector<NamedPolygon>& RegionPolygons() {
  static const std::vector<NamedPolygon> polygons = [] {
    std::mt19937_64 engine(kSeed);
    std::vector<NamedPolygon> result = TwelveEdgePolygons();
    for (const auto& [name, polygon] : DegeneratePolygons()) {
      result.push_back({name, polygon});
      result.push_back({name + ", shaken", Shaken(polygon, By(kShake), engine)});
    }
    result.push_back({"disc", RegularPolygon(24)});
    result.push_back({"annulus", Annulus(16, 2, 1.2)});
    result.push_back({"irregular 32", IrregularOutline(32, 0.9, 31)});
    return result;
  }();
  return polygons;
}

}  // namespace regrasp::contour
