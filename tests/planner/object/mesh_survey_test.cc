#include "planner/object/mesh_survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "planner/object/polygon_soup.h"
#include "tests/fixtures/soups.h"

namespace regrasp::object {
namespace mesh_survey_test {

using Eigen::Vector3d;
using namespace regrasp::soups;  // NOLINT: the meshes of this folder

PolygonSoup Box(double from, double to) {
  return BoxSoup(Vector3d::Constant(from), Vector3d::Constant(to));
}

TEST(MeshSurvey, FindsNothingWrongWithSoundBodies) {
  for (const PolygonSoup& soup : {UnitCubeSoup(), LBlockSoup(), HoleBlockSoup(), SphereSoup(9)}) {
    const MeshSurvey survey = SurveyMesh(soup);
    EXPECT_EQ(SurveyText(survey), "");
    EXPECT_EQ(survey.facets, std::ssize(soup.facets));
    EXPECT_EQ(survey.vertices, std::ssize(soup.vertices));
    ASSERT_EQ(survey.shells.size(), 1U);
    EXPECT_EQ(survey.shells[0].facets, survey.facets);
    EXPECT_EQ(survey.open_parts, 0);
  }
  EXPECT_NEAR(SurveyMesh(HoleBlockSoup()).shells[0].volume, 8, 1e-12);
  EXPECT_NEAR(SurveyMesh(LBlockSoup()).shells[0].volume, 3, 1e-12);
  EXPECT_NEAR(SurveyMesh(LBlockSoup()).diameter, 3, 1e-12);
}

TEST(MeshSurvey, CountsFacetsByWhatIsWrongWithThem) {
  PolygonSoup soup = UnitCubeSoup();
  soup.vertices.push_back({0, -0.5, -0.5});
  soup.vertices.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  soup.vertices[7].z() += 0.01;         // polygon 1 is bent, 0.0025 off its plane
  soup.facets.push_back({0, 8, 1});     // no area
  soup.facets.push_back({3, 3, 1});     // fewer than three corners
  soup.facets.push_back({2, 3, 1, 0});  // polygon 0 again
  soup.facets.push_back({6, 4, 0, 2});  // polygon 5 reversed
  soup.facets.push_back({0, 1, 2, 3});  // a bow tie
  soup.facets.push_back({0, 1, 9});     // NaN
  soup.facets.push_back({0, 1, 10});    // vertex index out of range
  soup.facets.push_back({0, -1, 2});    // vertex index out of range
  const MeshSurvey survey = SurveyMesh(soup);
  EXPECT_EQ(survey.facets, 14);
  EXPECT_EQ(survey.vertices, 9);
  EXPECT_EQ(survey.spoilt_facets, 3);
  EXPECT_EQ(survey.degenerate_facets, 2);
  EXPECT_EQ(survey.duplicate_facets, 1);
  EXPECT_EQ(survey.opposite_facets, 1);
  EXPECT_EQ(survey.twisted_facets, 1);
  EXPECT_EQ(survey.bent_facets, 1);
  EXPECT_NEAR(survey.largest_bend, 0.0025, 1e-5);
}

TEST(MeshSurvey, CountsEdgesAndTheirBorders) {
  PolygonSoup tube = UnitCubeSoup();
  tube.vertices[1].x() = tube.vertices[3].x() = tube.vertices[5].x() = tube.vertices[7].x() = 2.5;
  tube.facets.erase(tube.facets.begin() + 5);  // −x: 4 long
  tube.facets.erase(tube.facets.begin() + 1);  // +z: adjacent side of 3 × 1
  MeshSurvey survey = SurveyMesh(tube);
  EXPECT_EQ(survey.open_edges, 6);
  EXPECT_EQ(survey.borders, 1);
  EXPECT_NEAR(survey.longest_border, 4 * 3 - 2 * 1 - 0 - 2 * 1 + 2, 1e-12);
  EXPECT_EQ(survey.open_parts, 1);
  EXPECT_TRUE(survey.shells.empty());

  PolygonSoup ends = HoleBlockSoup();
  ends.facets.erase(ends.facets.begin());  // a polygon of the bottom, next to the hole
  PolygonSoup apart = Join(ends, UnitCubeSoup());
  apart.facets.pop_back();
  survey = SurveyMesh(apart);
  EXPECT_EQ(survey.open_edges, 8);
  EXPECT_EQ(survey.borders, 2);
  EXPECT_EQ(survey.open_parts, 2);

  PolygonSoup odd = UnitCubeSoup();
  std::ranges::reverse(odd.facets[2]);
  odd.vertices.push_back({3, 3, 3});
  odd.facets.push_back({0, 2, 8});
  survey = SurveyMesh(odd);
  EXPECT_EQ(survey.misoriented_edges, 4);
  EXPECT_EQ(survey.crowded_edges, 1);
  EXPECT_EQ(survey.open_edges, 2);
}

TEST(MeshSurvey, TellsShellsThatOverlapFromThoseInsideAndBeside) {
  PolygonSoup cavity = Box(0.1, 0.2);
  Turn(cavity);
  PolygonSoup soup = Join(Join(Join(Box(0, 1), cavity), Box(0.5, 1.4)), Box(3, 3.5));
  const MeshSurvey survey = SurveyMesh(soup);
  ASSERT_EQ(survey.shells.size(), 4U);
  EXPECT_NEAR(survey.shells[0].volume, 1, 1e-12);
  EXPECT_NEAR(survey.shells[1].volume, 0.729, 1e-12);
  EXPECT_NEAR(survey.shells[2].volume, 0.125, 1e-12);
  EXPECT_NEAR(survey.shells[3].volume, -0.001, 1e-12);
  EXPECT_EQ(survey.shells[3].first_facet, 6);
  EXPECT_TRUE(survey.shells[0].overlaps && survey.shells[1].overlaps);
  EXPECT_FALSE(survey.shells[2].overlaps || survey.shells[3].overlaps);
  EXPECT_FALSE(survey.shells[2].inside);
  EXPECT_TRUE(survey.shells[3].inside);
  EXPECT_GT(survey.crossing_pairs, 5);
  EXPECT_TRUE(survey.all_pairs_seen);
  EXPECT_THAT(SurveyText(survey),
              ::testing::EndsWith("4 closed shells (2 of them overlap, 1 lies inside another, "
                                  "with 53.9 %, 39.3 %, 6.74 %, 0.0539 % of the volume)"));
}

/// Objects with a common edge or side are separate shells if they can be distinguished.
TEST(MeshSurvey, BodiesThatShareAnEdgeAreTwoShells) {
  const MeshSurvey survey =
      SurveyMesh(Join(UnitCubeSoup(), BoxSoup({0.5, 0.5, -0.5}, {1, 1, 0.5})));
  EXPECT_EQ(survey.crowded_edges, 1);
  EXPECT_EQ(survey.shells.size(), 2U);
  EXPECT_EQ(survey.open_parts, 0);
}

/// All pairs of the large random triangles cross.
TEST(MeshSurvey, StopsCountingWhereThereIsTooMuch) {
  std::mt19937 random(5);
  std::normal_distribution<double> anywhere;
  PolygonSoup heap;
  for (int f = 0; f < 3000; ++f) {
    heap.facets.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    for (int k = 0; k < 3; ++k) {
      heap.vertices.push_back({anywhere(random), anywhere(random), anywhere(random)});
    }
  }
  const MeshSurvey survey = SurveyMesh(heap);
  EXPECT_EQ(survey.crossing_pairs, kMostCrossings);
  EXPECT_FALSE(survey.all_pairs_seen);
  EXPECT_THAT(SurveyText(survey), ::testing::HasSubstr("at least 10000 crossing pairs"));
}

TEST(MeshSurvey, OfShellsWithoutNumberNotEachPairIsLookedAt) {
  const auto row = [](int bodies) {
    PolygonSoup soup;
    for (int i = 0; i < bodies; ++i) {
      const int first = 4 * i;
      for (const Vector3d& p : CornerTetrahedronSoup().vertices) {
        soup.vertices.push_back(p + Vector3d(2 * i, 0, 0));
      }
      for (auto facet : CornerTetrahedronSoup().facets) {
        for (int& v : facet) v += first;
        soup.facets.push_back(facet);
      }
    }
    return SurveyMesh(soup);
  };
  EXPECT_EQ(row(100).shells.size(), 100U);
  EXPECT_TRUE(row(100).all_pairs_seen);
  EXPECT_EQ(row(6000).shells.size(), 6000U);
  EXPECT_FALSE(row(6000).all_pairs_seen);
}

TEST(MeshSurvey, TheCountsDoNotDependOnTheOrderOfFacetsAndWhereTheyBegin) {
  PolygonSoup soup = Join(Join(Box(0, 1), Box(0.5, 1.4)), SphereSoup(5));
  soup.facets.resize(soup.facets.size() - 4);
  const std::string before = SurveyText(SurveyMesh(soup));
  std::mt19937 random(3);
  std::ranges::shuffle(soup.facets, random);
  for (auto& facet : soup.facets) std::ranges::rotate(facet, facet.begin() + 1);
  EXPECT_EQ(SurveyText(SurveyMesh(soup)), before);
  EXPECT_THAT(before, ::testing::HasSubstr("open edges"));
}

TEST(MeshSurvey, WhatIsEmptyIsRefused) {
  EXPECT_THROW(static_cast<void>(SurveyMesh({})), MeshError);
  // Invalid polygons are counted even if no valid one remains.
  EXPECT_EQ(SurveyMesh({{}, {{0, 1, 2}, {}}}).spoilt_facets, 1);
}

}  // namespace mesh_survey_test
}  // namespace regrasp::object
