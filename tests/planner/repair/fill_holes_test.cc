#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "planner/repair/stages.h"

namespace regrasp::repair {
namespace fill_holes_test {

using Eigen::Vector3d;
using object::PolygonSoup;

/// Return a cone over a border, open at its wide end.
PolygonSoup ConeOver(const std::vector<Vector3d>& border) {
  PolygonSoup soup{border, {}};
  const int apex = static_cast<int>(border.size());
  soup.vertices.emplace_back(0, 0, -5);
  for (int i = 0; i < apex; ++i) soup.facets.push_back({i, apex, (i + 1) % apex});
  return soup;
}

/// Return a circle with a wave in height.
std::vector<Vector3d> Wave(int edges, double height) {
  std::vector<Vector3d> border;
  for (int i = 0; i < edges; ++i) {
    const double angle = 2 * std::numbers::pi * i / edges;
    border.emplace_back(std::cos(angle), std::sin(angle), height * std::cos(2 * angle));
  }
  return border;
}

/// Return a circle whose vertices are displaced by up to a tenth of its radius. With many edges
/// this is much more than the distance between neighbours.
std::vector<Vector3d> Tangle(int edges) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> off(-0.1, 0.1);
  std::vector<Vector3d> border = Wave(edges, 0);
  for (Vector3d& v : border) {
    for (double& x : v) x += off(generator);
  }
  return border;
}

TEST(FillHoles, ALongBorderIsFilledFlatOrNot) {
  for (const double height : {0.0, 0.3}) {
    const StageResult filled = FillHoles(ConeOver(Wave(3000, height)));
    EXPECT_FALSE(HasOpenEdges(filled.soup)) << height;
    EXPECT_EQ(filled.soup.facets.size(), 3000u + 2998u) << height;
  }
}

TEST(FillHoles, AShortTangleIsFilledAndALongOneIsLeftToOtherStages) {
  EXPECT_FALSE(HasOpenEdges(FillHoles(ConeOver(Tangle(60))).soup));
  EXPECT_THROW((void)FillHoles(ConeOver(Tangle(1000))), std::runtime_error);
}

}  // namespace fill_holes_test
}  // namespace regrasp::repair
