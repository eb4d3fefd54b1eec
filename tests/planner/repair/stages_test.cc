#include "planner/repair/stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <stdexcept>

#include "tests/fixtures/soups.h"

namespace regrasp::repair {
namespace run_stage_test {

StageResult CubeWithFacts() {
  StageResult result{soups::UnitCubeSoup()};
  result.facts["holes"] = 3;
  return result;
}

TEST(RunStage, ResultAndFactsComeBack) {
  const StageRun run = RunStage(CubeWithFacts, {});
  ASSERT_TRUE(run.result);
  EXPECT_EQ(run.result->facts["holes"], 3);
  EXPECT_EQ(run.result->soup.facets, soups::UnitCubeSoup().facets);
}

TEST(RunStage, AStageThatCannotGoOnSaysWhy) {
  const StageRun run = RunStage([]() -> StageResult { throw std::runtime_error("no"); }, {});
  EXPECT_FALSE(run.result);
  EXPECT_EQ(run.failure, "no");
}

TEST(RunStage, AStageThatCrashesTakesNothingWithIt) {
  const StageRun run = RunStage([]() -> StageResult { std::abort(); }, {});
  EXPECT_FALSE(run.result);
  EXPECT_EQ(run.failure, "crashed or exceeded its memory limit");
}

}  // namespace run_stage_test

namespace canonical_order_test {

using object::PolygonSoup;
using namespace regrasp::soups;  // NOLINT: the meshes of objects

/// Number a surface randomly.
PolygonSoup Shuffled(const PolygonSoup& soup, std::mt19937& random) {
  std::vector<int> place(soup.vertices.size());
  for (std::size_t v = 0; v < place.size(); ++v) place[v] = static_cast<int>(v);
  std::ranges::shuffle(place, random);
  PolygonSoup shuffled = soup;
  for (std::size_t v = 0; v < place.size(); ++v) shuffled.vertices[place[v]] = soup.vertices[v];
  for (auto& facet : shuffled.facets) {
    for (int& v : facet) v = place[v];
    std::ranges::rotate(facet, facet.begin() + std::ptrdiff_t(random() % facet.size()));
  }
  std::ranges::shuffle(shuffled.facets, random);
  return shuffled;
}

TEST(CanonicalOrder, DoesNotDependOnHowASurfaceIsNumbered) {
  std::mt19937 random(3);
  for (const PolygonSoup& soup : {UnitCubeSoup(), LBlockSoup(), SphereSoup(7)}) {
    const PolygonSoup ordered = InCanonicalOrder(soup);
    EXPECT_EQ(ordered.facets.size(), soup.facets.size());
    for (int i = 0; i < 10; ++i) {
      const PolygonSoup shuffled = Shuffled(soup, random);
      EXPECT_NE(shuffled.vertices, ordered.vertices);
      EXPECT_EQ(InCanonicalOrder(shuffled).vertices, ordered.vertices);
      EXPECT_EQ(InCanonicalOrder(shuffled).facets, ordered.facets);
    }
  }
}

TEST(CanonicalOrder, KeepsOrientationAndWhatWasFilled) {
  PolygonSoup cube = UnitCubeSoup();
  cube.filled.assign(6, false);
  cube.filled[4] = true;
  const PolygonSoup ordered = InCanonicalOrder(cube);
  std::vector<Eigen::Vector3d> marked;
  for (std::size_t f = 0; f < 6; ++f) {
    if (!ordered.filled[f]) continue;
    for (const int v : ordered.facets[f]) marked.push_back(ordered.vertices[v]);
  }
  std::vector<Eigen::Vector3d> was;
  for (const int v : cube.facets[4]) was.push_back(cube.vertices[v]);
  ASSERT_EQ(marked.size(), 4U);
  const auto first = std::ranges::find(was, marked[0]);
  ASSERT_NE(first, was.end());
  std::ranges::rotate(was, first);
  EXPECT_EQ(marked, was);
}

}  // namespace canonical_order_test
}  // namespace regrasp::repair
