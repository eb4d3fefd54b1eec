#include "planner/object/facet_triangulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <optional>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {
namespace facet_triangulation_test {

using Eigen::Vector3d;
using ::testing::HasSubstr;

/// Counter-clockwise outlines in the plane: a square, an L, a comb with three teeth.
const std::vector<std::vector<Eigen::Vector2d>> kOutlines = {
    {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
    {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},
    {{0, 0},
     {5, 0},
     {5, 3},
     {4, 3},
     {4, 1},
     {3, 1},
     {3, 3},
     {2, 3},
     {2, 1},
     {1, 1},
     {1, 3},
     {0, 3}}};
constexpr double kAreas[] = {1, 5, 11};

/// Make a soup of adjacent polygons without shared vertices, rotated in space.
WeldedSoup FacetsOf(const std::vector<std::vector<Eigen::Vector2d>>& outlines,
                    const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
  WeldedSoup soup;
  for (const auto& outline : outlines) {
    soup.facets.emplace_back();
    for (const Eigen::Vector2d& p : outline) {
      soup.facets.back().push_back(static_cast<int>(soup.vertices.size()));
      soup.vertex_in_file.push_back(soup.facets.back().back());
      soup.vertices.push_back(turn * Vector3d(p.x(), p.y(), 0));
    }
  }
  return soup;
}

std::optional<MeshDefect> DefectOf(const WeldedSoup& soup, double diameter) {
  try {
    (void)TriangulateFacets(soup, diameter, "file.ply");
  } catch (const MeshError& error) {
    EXPECT_THAT(error.what(), HasSubstr("file.ply: facet 0: "));
    return error.defect();
  }
  return std::nullopt;
}

TEST(FacetTriangulation, TrianglesCoverTheirFacetAndFaceAsItDoesHoweverItLies) {
  const Eigen::Quaterniond tilted(Eigen::AngleAxisd(2, Vector3d(1, 2, 3).normalized()));
  const Eigen::Quaterniond over(0, 1, 0, 0);
  for (const Eigen::Quaterniond& turn : {Eigen::Quaterniond::Identity(), tilted, over}) {
    const WeldedSoup soup = FacetsOf(kOutlines, turn);
    const TriangleMesh mesh = TriangulateFacets(soup, 5, "facets");
    EXPECT_EQ(mesh.vertices, soup.vertices);
    EXPECT_EQ(mesh.flat_count, 3);
    std::vector<double> areas(3, 0);
    std::vector<int> counts(3, 0);
    for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
      const int facet = mesh.facet_of_triangle[t];
      const double area = DoubleAreaVector(mesh, t).dot(turn * Vector3d::UnitZ()) / 2;
      EXPECT_GT(area, 0.1) << "triangle " << t;
      areas[facet] += area;
      ++counts[facet];
      for (const int v : mesh.triangles[t]) EXPECT_THAT(soup.facets[facet], ::testing::Contains(v));
    }
    for (int facet = 0; facet < 3; ++facet) {
      // Overlapping or reversed triangles would make the sum too large.
      EXPECT_NEAR(areas[facet], kAreas[facet], 1e-12);
      EXPECT_EQ(counts[facet], std::ssize(kOutlines[facet]) - 2);
    }
  }
}

TEST(FacetTriangulation, ACornerMayLieOffThePlaneByAShareOfTheDiameter) {
  // Lifting one corner of a square by d moves each corner d/4 off the mean plane.
  WeldedSoup soup = FacetsOf({kOutlines[0]});
  const double diameter = 100;
  const auto flat_parts = [&](double off_plane) {
    soup.vertices[2].z() = 4 * off_plane * diameter;
    return TriangulateFacets(soup, diameter, "facets").flat_count;
  };
  EXPECT_EQ(flat_parts(0.99 * kPlanarTolerance), 1);
  EXPECT_EQ(flat_parts(1.01 * kPlanarTolerance), 2) << "bent: each triangle is flat by itself";
  EXPECT_EQ(flat_parts(0.99 * kBentTolerance), 2);
  soup.vertices[2].z() = 4 * 1.1 * kBentTolerance * diameter;
  EXPECT_EQ(DefectOf(soup, diameter), MeshDefect::kNotPlanar);
}

TEST(FacetTriangulation, RefusesFacetsWithoutAreaAndOutlinesThatMeetThemselves) {
  EXPECT_EQ(DefectOf(FacetsOf({{{0, 0}, {1, 1}, {3, 3}}}), 5), MeshDefect::kDegenerateFacet);
  EXPECT_EQ(DefectOf(FacetsOf({{{0, 0}, {1, 1}, {3, 3}, {2, 2}}}), 5),
            MeshDefect::kDegenerateFacet);
  EXPECT_EQ(DefectOf(FacetsOf({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}), 5),
            MeshDefect::kSelfIntersecting)
      << "a bow tie, whose area cancels";
  EXPECT_EQ(DefectOf(FacetsOf({{{0, 0}, {3, 0}, {3, 1}, {1, -1}, {0, 1}}}), 5),
            MeshDefect::kSelfIntersecting);
  EXPECT_EQ(DefectOf(FacetsOf({{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}}), 5),
            MeshDefect::kSelfIntersecting)
      << "a corner on another side";
}

}  // namespace facet_triangulation_test
}  // namespace regrasp::object
