#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/object/polygon.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/contour/contour_planner.h"
#include "tests/fixtures/peak_memory.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace graph_memory_test {

using ::testing::HasSubstr;

/// Make a gear with four edges per tooth, two at the outer radius and two at the inner radius: as
/// many sets as pieces.
object::Polygon Gear(int edges) {
  object::PolygonRings rings(1);
  for (int k = 0; k < edges; ++k) {
    const double radius = k % 4 < 2 ? 1 : 0.8;
    const double angle = 2 * std::numbers::pi * k / edges;
    rings[0].emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return object::Polygon::FromRings(std::move(rings), "gear");
}

/// Make a smooth outline: few sets with many pieces.
object::Polygon Egg(int edges) {
  return Mapped(RegularPolygon(edges), [](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(2 * p.x(), p.y() * (1 + 0.2 * p.x()));
  });
}

struct Case {
  NamedPolygon object;
  double degrees;
};

const std::vector<Case>& Cases() {
  static const std::vector<Case> cases = {
      {{"disc 1001", RegularPolygon(1001)}, 40},
      {{"disc 2001", RegularPolygon(2001)}, 10},
      {{"egg 3000", Egg(3000)}, 20},
      {{"egg 5000", Egg(5000)}, 5},
      {{"gear 1000", Gear(1000)}, 10},
      {{"gear 700", Gear(700)}, 30},
      {{"irregular 1000", IrregularOutline(1000, 0.99, 1)}, 20},
      {{"irregular 2000", IrregularOutline(2000, 0.999, 2)}, 5}};
  return cases;
}

#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer keeps freed memory
TEST(ContourGraphMemory, TheEstimateIsWithinAFactorOfTwoOfWhatIsUsed) {
  for (const auto& [object, degrees] : Cases()) {
    const double used = PeakBytesOf(
        [&] { static_cast<void>(ContourGraph(object.polygon, Radians(degrees)).vertex_count()); });
    const double estimate = EstimateContourGraph(object.polygon, Radians(degrees)).bytes();
    EXPECT_GT(used, 1e7) << object.name;
    EXPECT_GT(estimate, used / 2) << object.name;
    EXPECT_LT(estimate, used * 2) << object.name;
  }
}

TEST(ContourGraphMemory, TheEstimateOfAPlanIsWithinAFactorOfTwoOfWhatIsUsed) {
  for (const auto& [object, degrees] : Cases()) {
    planning::PlanRequest options = RequestAt(degrees);
    options.criteria.min_quality = 0;
    const double used = PeakBytesOf([&] {
      static_cast<void>(PlanWith(ContourPlanner(), object.polygon, Random(), Random(), options));
    });
    const double estimate =
        EstimateContourPlan(object.polygon, options.criteria.friction_angle).bytes();
    EXPECT_GT(used, 1e7) << object.name;
    EXPECT_GT(estimate, used / 2) << object.name;
    EXPECT_LT(estimate, used * 2) << object.name;
  }
}
#endif

TEST(ContourGraphMemory, TheEstimateGrowsWithTheEdges) {
  double last = 0;
  for (const int n : {4, 7, 15, 31, 63, 127, 1001, 10'001}) {
    const MemoryNeed need = EstimateContourGraph(RegularPolygon(n), Radians(15.5));
    EXPECT_EQ(need.count, n);
    EXPECT_GT(need.bytes(), last) << n;
    EXPECT_GE(EstimateContourPlan(RegularPolygon(n), Radians(15.5)).bytes(), need.bytes()) << n;
    last = need.bytes();
  }
  EXPECT_GT(last, 3e8);
}

TEST(ContourGraphMemory, APlanOnAGraphThatDoesNotFitIsNone) {
  planning::PlanRequest options = RequestAt(20);
  options.memory = 1e8;
  const planning::PlanResult result =
      PlanWith(ContourPlanner(), RegularPolygon(10'001), Random(), Random(), options);
  EXPECT_FALSE(result.plan.has_value());
  EXPECT_THAT(result.message, HasSubstr("10001 edges require"));
}

}  // namespace graph_memory_test
}  // namespace regrasp::contour
