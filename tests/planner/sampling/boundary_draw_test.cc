#include "planner/sampling/boundary_draw.h"

#include <gtest/gtest.h>

#include "planner/base/angle.h"
#include "planner/object/object.h"

namespace regrasp {
namespace {

TEST(DrawAnyGrasp, DrawsNoTwoContactsOnATriangleWhoseEdgesAreNotOpposedEnough) {
  // The normals of an equilateral triangle's edges are 60 degrees from opposed: two contacts need a
  // half-angle of more than 30 degrees.
  const ObjectFile file = ReadObject(REGRASP_SOURCE_DIR "/models/triangle.wkt");
  const auto& triangle = dynamic_cast<const Polygon&>(*file.object);
  for (const double degrees : {5.0, 25.0, 29.9, 31.0, 50.0}) {
    const GraspEvaluator evaluator(triangle, {Radians(degrees), 0});
    RandomStream random(3, RandomUse::kStart);
    RandomStream same(3, RandomUse::kStart);
    const auto grasp = DrawAnyGrasp(triangle, 2, 2, evaluator, random);
    EXPECT_EQ(grasp.has_value(), degrees > 30) << degrees;
    if (grasp) continue;
    // Nothing but the number was drawn.
    (void)same.Index(1);
    EXPECT_EQ(random.Uniform(), same.Uniform());
    const auto three = DrawAnyGrasp(triangle, 2, 3, evaluator, random);
    ASSERT_TRUE(three);
    EXPECT_EQ(three->size(), 3U);
  }
}

}  // namespace
}  // namespace regrasp
