#include "bench/hand_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "planner/object/body_measures.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::bench {
namespace hand_bodies_test {

/// Area of a regular polygon, mm². @param radius  distance of its corners from the centre, mm.
double PolygonArea(int sides, double radius) {
  return sides / 2.0 * radius * radius * std::sin(2 * std::numbers::pi / sides);
}

/// Volume of a frustum of regular polygons, mm³.
double FrustumVolume(int sides, double height, double radius, double other_radius) {
  const double a = PolygonArea(sides, radius);
  const double b = PolygonArea(sides, other_radius);
  return height / 3 * (a + b + std::sqrt(a * b));
}

struct Expected {
  double volume_mm3;
  Eigen::Vector3d size_mm;  ///< extents along x, y and z
};

/// Volumes and extents by formulas of solid geometry.
std::map<std::string, Expected> ExpectedBodies() {
  const auto drum = [](int sides, double diameter, double length) {
    return Expected{PolygonArea(sides, diameter / 2) * length, {diameter, diameter, length}};
  };
  return {{"box", {30.0 * 40 * 80, {30, 40, 80}}},
          {"rod-square", {15.0 * 15 * 120, {15, 15, 120}}},
          {"rod-20", drum(20, 15, 120)},
          {"cap", drum(32, 60, 20)},
          {"pen",
           {FrustumVolume(20, 20, 1, 6) + PolygonArea(20, 6) * 118 + FrustumVolume(20, 2, 6, 4),
            {12, 12, 140}}},
          {"screwdriver",
           {FrustumVolume(20, 4, 12, 16) + PolygonArea(20, 16) * 93 + FrustumVolume(20, 8, 16, 8) +
                PolygonArea(20, 4) * 110,
            {32, 32, 215}}}};
}

Eigen::Vector3d SizeOf(const HandBody& body) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : body.solid().vertices()) box.extend(vertex);
  return box.sizes();
}

/// Vertices are rounded to a millionth of a millimetre.
TEST(EverydayBodies, AreClosedSolidsOfTheirVolumesAndExtents) {
  const std::map<std::string, Expected> expected = ExpectedBodies();
  const std::vector<HandBody> bodies = EverydayBodies();
  ASSERT_EQ(bodies.size(), expected.size());
  for (const HandBody& body : bodies) {
    const auto& [volume_mm3, size_mm] = expected.at(body.name);
    const double mass_kg = object::MeasureBody(body.solid(), body.scale).mass_kg;
    // The density is that of water: 1 g per cm³.
    EXPECT_NEAR(mass_kg * 1e6, volume_mm3, 1e-5 * volume_mm3) << body.name;
    EXPECT_LT((SizeOf(body) * body.scale * 1e3 - size_mm).cwiseAbs().maxCoeff(), 1e-5) << body.name;
  }
}

/// Negative control: a body without one of its planar faces is not closed.
TEST(EverydayBodies, AreRefusedIfTheyAreOpen) {
  int checked = 0;
  for (const HandBody& body : EverydayBodies()) {
    const std::string open = body.bytes.substr(0, body.bytes.rfind("\nf ") + 1);
    EXPECT_ANY_THROW((void)BodyOf(body.name, body.what, open, body.scale)) << body.name;
    ++checked;
  }
  EXPECT_EQ(checked, 6);
}

TEST(EverydayBodies, HaveTheSameBytesEachTime) {
  const std::vector<HandBody> first = EverydayBodies();
  const std::vector<HandBody> second = EverydayBodies();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].name, second[i].name);
    EXPECT_TRUE(first[i].bytes == second[i].bytes) << first[i].name;
  }
}

TEST(HandBodies, HaveNamesOfTheirOwn) {
  std::map<std::string, std::string> bytes_of;
  for (const auto& bodies : {TenBodies(ProjectPath("models")),
                             CompetitionBodies(ProjectPath("models")), EverydayBodies()}) {
    for (const HandBody& body : bodies) {
      // The 50 mm cube occurs in two groups.
      const auto [found, is_new] = bytes_of.try_emplace(body.name, body.bytes);
      EXPECT_TRUE(is_new || found->second == body.bytes) << body.name;
    }
  }
  EXPECT_EQ(bytes_of.size(), 10U + 4 + 6);
}

}  // namespace hand_bodies_test
}  // namespace regrasp::bench
