#include "planner/object/weld.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/object/polygon_soup.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace weld_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Give every polygon its own corners, as in STL.
PolygonSoup TakenApart(const PolygonSoup& soup) {
  PolygonSoup apart;
  for (const auto& facet : soup.facets) {
    apart.facets.emplace_back();
    for (const int v : facet) {
      apart.facets.back().push_back(static_cast<int>(apart.vertices.size()));
      apart.vertices.push_back(soup.vertices[v]);
    }
  }
  return apart;
}

TEST(WeldVertices, PutsTogetherWhatWasTakenApart) {
  for (const PolygonSoup& soup :
       {soups::UnitCubeSoup(), soups::HoleBlockSoup(), soups::SphereSoup(6)}) {
    const PolygonSoup apart = TakenApart(soup);
    const WeldedSoup welded = WeldVertices(apart, "soup");
    EXPECT_EQ(welded.vertices.size(), soup.vertices.size());
    ASSERT_EQ(welded.facets.size(), soup.facets.size());
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
      ASSERT_EQ(welded.facets[f].size(), soup.facets[f].size());
      for (std::size_t k = 0; k < soup.facets[f].size(); ++k) {
        EXPECT_EQ(welded.vertices[welded.facets[f][k]], soup.vertices[soup.facets[f][k]]);
      }
    }
    for (std::size_t v = 0; v < welded.vertices.size(); ++v) {
      const auto first = std::ranges::find(apart.vertices, welded.vertices[v]);
      EXPECT_EQ(welded.vertex_in_file[v], first - apart.vertices.begin());
    }
  }
}

TEST(WeldVertices, KeepsApartWhatDiffersInTheLastPlaceAndDropsWhatNoFacetUses) {
  const double next = std::nextafter(1.0, 2.0);
  const PolygonSoup soup = {{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {next, 0, 0}, {0, 0, 1}},
                            {{1, 2, 3}, {1, 4, 5}}};
  const WeldedSoup welded = WeldVertices(soup, "soup");
  EXPECT_THAT(welded.vertex_in_file, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(welded.facets, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 3, 4)));
}

TEST(WeldVertices, TakesMinusZeroForZero) {
  const PolygonSoup soup = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, 0, 1}},
                            {{0, 1, 2}, {3, 1, 4}}};
  const WeldedSoup welded = WeldVertices(soup, "soup");
  EXPECT_EQ(welded.vertices.size(), 4U);
  for (const Eigen::Vector3d& v : welded.vertices) {
    for (const double x : v) EXPECT_FALSE(std::signbit(x));
  }
}

TEST(WeldVertices, DropsCornersThatRepeatTheOneBeforeAndFacetsThatThatLeavesWithTwo) {
  const PolygonSoup soup = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {7, 7, 7}},
      {{0, 1, 3, 2}, {0, 1, 2, 0}, {0, 1, 3}, {5, 5, 5}, {}, {0, 1}, {0, 4, 2, 4}}};
  const WeldedSoup welded = WeldVertices(soup, "soup");
  EXPECT_THAT(welded.facets,
              ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 1, 2), ElementsAre(), ElementsAre(),
                          ElementsAre(), ElementsAre(), ElementsAre(0, 3, 2, 3)));
  EXPECT_THAT(welded.vertex_in_file, ElementsAre(0, 1, 2, 4)) << "without those of what is dropped";
}

TEST(WeldVertices, NamesWhatIsWrong) {
  const auto refusal = [](const PolygonSoup& soup) {
    try {
      (void)WeldVertices(soup, "file.stl");
    } catch (const MeshError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  EXPECT_EQ(refusal({corners, {{0, 1, 2}}}), "");
  EXPECT_EQ(
      refusal({corners, {}}),
      "file.stl: empty: facets not found, found only 4 points; help: reconstruct a surface with "
      "repair");
  EXPECT_THAT(refusal({corners, {{0, 1, 2}, {0, 1, 4}}}),
              HasSubstr("facet 1: vertex index 4 must be at least 0 and less than 4"));
  EXPECT_THAT(refusal({corners, {{0, 1, -1}}}), HasSubstr("vertex index -1 must be at least 0"));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), -2 * kMaxCoordinate}) {
    EXPECT_THAT(refusal({{{0, 0, 0}, {1, 0, 0}, {0, bad, 0}}, {{0, 1, 2}}}),
                HasSubstr("vertex 2: the coordinate "));
  }
}

}  // namespace weld_test
}  // namespace regrasp::object
