#include "bench/hand_bodies.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/read_object.h"

namespace regrasp::bench {
namespace {

using Eigen::Vector3d;

/// Diameter of objects other than cubes.
constexpr double kDiameter_mm = 75;

/// Tube along a curve in the x-z plane, closed at both ends, mm.
struct Tube {
  int rings;
  int sides;
  double bend;  ///< bend angle from end to end, radians
  double length;
  double radius;
};

object::PolygonSoup SoupOf(const Tube& tube) {
  object::PolygonSoup soup;
  for (int i = 0; i < tube.rings; ++i) {
    const double s = i / (tube.rings - 1.0) - 0.5;
    const double angle = tube.bend * s;
    const double curve = tube.bend == 0 ? 0 : tube.length / tube.bend;
    const Vector3d centre =
        tube.bend == 0 ? Vector3d(0, 0, tube.length * s)
                       : Vector3d(curve * (1 - std::cos(angle)), 0, curve * std::sin(angle));
    const Vector3d across(std::cos(angle), 0, -std::sin(angle));
    for (int k = 0; k < tube.sides; ++k) {
      const double turn = 2 * std::numbers::pi * k / tube.sides;
      soup.vertices.push_back(
          centre + tube.radius * (std::cos(turn) * across + std::sin(turn) * Vector3d::UnitY()));
    }
  }
  std::vector<int> bottom;
  std::vector<int> top;
  for (int k = 0; k < tube.sides; ++k) {
    const int next = (k + 1) % tube.sides;
    for (int i = 0; i + 1 < tube.rings; ++i) {
      const int a = i * tube.sides + k;
      const int b = i * tube.sides + next;
      soup.facets.push_back({a, b, b + tube.sides});
      soup.facets.push_back({a, b + tube.sides, a + tube.sides});
    }
    bottom.insert(bottom.begin(), k);
    top.push_back((tube.rings - 1) * tube.sides + k);
  }
  soup.facets.push_back(bottom);
  soup.facets.push_back(top);
  return soup;
}

/// Coordinates are rounded to a millionth of a unit, so that the bytes do not depend on the last
/// bits of a sine.
std::string ObjText(const object::PolygonSoup& soup) {
  constexpr int kDecimals = 6;
  std::string text;
  for (const Vector3d& vertex : soup.vertices) {
    text += "v";
    for (const double x : vertex) text += " " + FormatFixed(x, kDecimals);
    text += "\n";
  }
  for (const std::vector<int>& facet : soup.facets) {
    text += "f";
    for (const int corner : facet) text += " " + std::to_string(corner + 1);
    text += "\n";
  }
  return text;
}

HandBody TubeBody(const std::string& name, const std::string& what, const Tube& tube) {
  constexpr double kMillimetre = 1e-3;
  return BodyOf(name, what, ObjText(SoupOf(tube)), kMillimetre);
}

/// Return a model of models/ scaled to a diameter. The scale has six digits, so that a user can
/// type it.
HandBody ModelBody(const std::filesystem::path& models, const std::string& name,
                   const std::string& model, const std::string& what, double diameter_mm) {
  HandBody body = BodyOf(name, what, ReadFile(models / (model + ".obj")), 1);
  body.file.file = model + ".obj";
  constexpr int kDigits = 6;
  const double scale = 1e-3 * diameter_mm / body.file.object->diameter();
  body.scale = *ParseDouble(FormatShort(scale, kDigits));
  return body;
}

HandBody Cube(const std::filesystem::path& models, int edge_mm) {
  const std::string edge = std::to_string(edge_mm);
  return ModelBody(models, "cube-" + edge, "cube", "cube, edge " + edge + " mm",
                   edge_mm * std::sqrt(3.0));
}

}  // namespace

HandBody BodyOf(const std::string& name, const std::string& what, std::string bytes, double scale) {
  const std::string file = name + ".obj";
  auto solid = std::make_unique<object::Polyhedron>(
      object::Polyhedron::FromSoup(object::ReadObj(bytes, file), file));
  object::ObjectFile object{file, Sha256(bytes), std::move(solid)};
  return {name, what, std::move(bytes), std::move(object), scale};
}

std::vector<HandBody> TenBodies(const std::filesystem::path& models) {
  const std::string across = ", " + FormatShort(kDiameter_mm) + " mm across";
  const auto model = [&](const std::string& name, const std::string& file) {
    return ModelBody(models, name, file, name + across, kDiameter_mm);
  };
  std::vector<HandBody> bodies;
  for (const int edge_mm : {40, 50, 60}) bodies.push_back(Cube(models, edge_mm));
  bodies.push_back(TubeBody("cylinder", "cylinder, diameter 44 mm, 60 mm tall",
                            {.rings = 2, .sides = 32, .bend = 0, .length = 60, .radius = 22}));
  bodies.push_back(model("prism", "prism"));
  bodies.push_back(model("L-block", "l_block"));
  bodies.push_back(model("duck", "duck500"));
  bodies.push_back(model("mug", "mug500"));
  bodies.push_back(model("ellipsoid", "ellipsoid500"));
  bodies.push_back(TubeBody("banana", "bent tube, diameter 32 mm, 90 mm long, bent by 69 degrees",
                            {.rings = 13, .sides = 16, .bend = 1.2, .length = 90, .radius = 16}));
  return bodies;
}

std::vector<HandBody> CompetitionBodies(const std::filesystem::path& models) {
  std::vector<HandBody> bodies;
  for (const int edge_mm : {50, 90}) bodies.push_back(Cube(models, edge_mm));
  for (const int diameter_mm : {60, 80, 100}) {
    const std::string diameter = std::to_string(diameter_mm);
    bodies.push_back(
        TubeBody("cylinder-" + diameter, "cylinder, diameter " + diameter + " mm, 80 mm tall",
                 {.rings = 2, .sides = 32, .bend = 0, .length = 80, .radius = diameter_mm / 2.0}));
  }
  return bodies;
}

}  // namespace regrasp::bench
