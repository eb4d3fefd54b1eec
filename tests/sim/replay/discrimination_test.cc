#include <gtest/gtest.h>

#include "tests/sim/planar_cases.h"
#include "tests/sim/replay/discriminate.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace discrimination_test {

constexpr int kGraspsPerObject = 75;
constexpr int kGraspsPerPolygon = 100;
constexpr unsigned kSeed = 20240607;
constexpr unsigned kPlanarSeed = 20240608;

TEST(Discrimination, GraspsBelowTheirCriticalFrictionFailAndGoodOnesAbovePass) {
  DiscriminationCount count;
  for (const std::string name : {"cube.obj", "l_block.obj"}) {
    const object::ObjectFile file = ReadModel(name);
    const auto& body = dynamic_cast<const object::Polyhedron&>(*file.object);
    count += Discriminate(body, name, kGraspsPerObject, kSeed, [&](int, std::mt19937& random) {
      plan::FingerGrasp grasp;
      for (FingerIndex f{0}; f < 4; ++f) grasp.push_back({f, DrawContact(body, random)});
      return grasp;
    });
  }
  ExpectManyDiscriminated(count, "grasps");
}

TEST(PlanarDiscrimination, GraspsBelowTheirCriticalFrictionFailAndGoodOnesAbovePass) {
  DiscriminationCount count;
  for (const auto& [name, polygon] :
       {std::pair{"quadrilateral",
                  object::Polygon::FromWkt("POLYGON((0 0, .09 .01, .07 .06, .01 .05, 0 0))",
                                           "quadrilateral")},
        {"L", MakeL()}}) {
    count += Discriminate(polygon, name, kGraspsPerPolygon, kPlanarSeed,
                          [&](int index, std::mt19937& random) {
                            plan::FingerGrasp grasp;
                            for (int f = 0; f < 2 + index % 2; ++f) {
                              grasp.push_back(DrawOnBoundary(polygon, f, random));
                            }
                            return grasp;
                          });
  }
  ExpectManyDiscriminated(count, "planar grasps");
}

}  // namespace discrimination_test
}  // namespace regrasp::sim
