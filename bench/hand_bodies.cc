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

/// Point of the profile of a solid of revolution, mm.
struct ProfilePoint {
  double z;
  double radius;
};

/// Return a solid of revolution about z, approximated by flat sides.
/// @param profile  points from the bottom to the top, with positive radii of the corners.
/// @param phase  angle of the first corner from x, radians.
object::PolygonSoup Revolved(const std::vector<ProfilePoint>& profile, int sides,
                             double phase = 0) {
  object::PolygonSoup soup;
  for (const auto& [z, radius] : profile) {
    for (int k = 0; k < sides; ++k) {
      const double turn = phase + 2 * std::numbers::pi * k / sides;
      soup.vertices.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
    }
  }
  const int last = static_cast<int>(profile.size()) - 1;
  std::vector<int> bottom;
  std::vector<int> top;
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    for (int i = 0; i < last; ++i) {
      const int a = i * sides + k;
      const int b = i * sides + next;
      soup.facets.push_back({a, b, b + sides});
      soup.facets.push_back({a, b + sides, a + sides});
    }
    bottom.insert(bottom.begin(), k);
    top.push_back(last * sides + k);
  }
  soup.facets.push_back(bottom);
  soup.facets.push_back(top);
  return soup;
}

/// Return a straight prism whose corners have a distance of `radius` from z, mm.
object::PolygonSoup Prism(double radius, double length, int sides, double phase = 0) {
  return Revolved({{-length / 2, radius}, {length / 2, radius}}, sides, phase);
}

/// Return a box with these edges along x, y and z, mm.
object::PolygonSoup Box(const Vector3d& edges) {
  object::PolygonSoup soup;
  for (const int corner : {0, 1, 3, 2, 4, 5, 7, 6}) {
    const Vector3d sign((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5);
    soup.vertices.emplace_back(edges.cwiseProduct(sign));
  }
  soup.facets = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return soup;
}

/// Dimensions of a screwdriver, mm.
struct Screwdriver {
  double handle_diameter;
  double handle_length;
  double shaft_diameter;
  double shaft_length;
  double chamfer;   ///< of the free end of the handle
  double shoulder;  ///< length of the cone from the handle to twice the diameter of the shaft
};

object::PolygonSoup SoupOf(const Screwdriver& driver, int sides) {
  const double radius = driver.handle_diameter / 2;
  const double shaft = driver.shaft_diameter / 2;
  const double end = driver.handle_length;
  return Revolved({{0, radius - driver.chamfer},
                   {driver.chamfer, radius},
                   {end - driver.shoulder, radius},
                   {end, 2 * shaft},
                   {end, shaft},
                   {end + driver.shaft_length, shaft}},
                  sides);
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

HandBody MillimetreBody(const std::string& name, const std::string& what,
                        const object::PolygonSoup& soup) {
  constexpr double kMillimetre = 1e-3;
  return BodyOf(name, what, ObjText(soup), kMillimetre);
}

HandBody TubeBody(const std::string& name, const std::string& what, const Tube& tube) {
  return MillimetreBody(name, what, SoupOf(tube));
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

std::vector<HandBody> EverydayBodies() {
  constexpr int kSides = 20;
  constexpr double kQuarter = std::numbers::pi / 4;
  constexpr Screwdriver kScrewdriver = {.handle_diameter = 32,
                                        .handle_length = 105,
                                        .shaft_diameter = 8,
                                        .shaft_length = 110,
                                        .chamfer = 4,
                                        .shoulder = 8};
  std::vector<HandBody> bodies;
  bodies.push_back(MillimetreBody("box", "box, 30 x 40 x 80 mm", Box({30, 40, 80})));
  bodies.push_back(MillimetreBody("rod-square", "square rod, 15 x 15 x 120 mm",
                                  Prism(7.5 * std::numbers::sqrt2, 120, 4, kQuarter)));
  bodies.push_back(MillimetreBody("rod-20", "rod with 20 sides, diameter 15 mm, 120 mm long",
                                  Prism(7.5, 120, kSides)));
  bodies.push_back(
      MillimetreBody("cap", "cap, diameter 60 mm, 20 mm tall, 32 sides", Prism(30, 20, 32)));
  bodies.push_back(MillimetreBody("pen",
                                  "pen, diameter 12 mm, 140 mm long, 20 sides, conical point",
                                  Revolved({{0, 1}, {20, 6}, {138, 6}, {140, 4}}, kSides)));
  bodies.push_back(MillimetreBody("screwdriver",
                                  "screwdriver, handle 32 x 105 mm, shaft 8 x 110 mm, 20 sides",
                                  SoupOf(kScrewdriver, kSides)));
  return bodies;
}

}  // namespace regrasp::bench
