// Graphs that are known by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/polyhedron_stone.h"
#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace known_answers_test {

using Eigen::Vector3d;

bool Contains(PolyhedronGraph& graph, const FocusCell& cell, const Vector3d& x) {
  return std::ranges::any_of(cell.pieces, [&](const FocusPiece& piece) {
    return std::ranges::all_of(piece.halves, [&](HalfIndex half) {
      return graph.finder().VolumeOf(half, cell.tangent).At(x) < 0;
    });
  });
}

TEST(PolyhedronGraph, OfARegularTetrahedronIsOneCellAboutItsCentre) {
  const object::Polyhedron body = RegularTetrahedron();
  for (const double degrees : {1, 10, 19}) {
    PolyhedronGraph graph(body, Radians(degrees), planning::Spanning::kUniform);
    EXPECT_EQ(graph.candidate_count(), 1);
    EXPECT_EQ(graph.combination_count(), 1);
    ASSERT_EQ(graph.vertex_count(), 1);
    EXPECT_TRUE(graph.switches().empty());
    const FocusCell& cell = graph.cells().front();
    EXPECT_EQ(cell.faces, (FaceQuadruple{FaceIndex(0), FaceIndex(1), FaceIndex(2), FaceIndex(3)}));
    EXPECT_EQ(cell.tangent, std::tan(Radians(degrees)));
    EXPECT_TRUE(Contains(graph, cell, Vector3d::Zero()));
    // Inside, or outside one face. Past an edge, no foot is on the faces at the edge, because cot φ
    // > tan 70.5°.
    EXPECT_EQ(cell.pieces.size(), 5U);
    // Outside the face opposite (1, 1, 1), slightly below its middle, (−1, −1, −1)/3.
    EXPECT_TRUE(Contains(graph, cell, Vector3d::Constant(-0.35)));
    EXPECT_FALSE(Contains(graph, cell, Vector3d::Constant(1.5)));
    EXPECT_FALSE(Contains(graph, cell, Vector3d::Constant(-1.5)));
  }
}

TEST(PolyhedronGraph, OfARegularTetrahedronEndsAtTheArcSineOfAThird) {
  const object::Polyhedron body = RegularTetrahedron();
  const double limit = std::asin(1.0 / 3);
  EXPECT_EQ(PolyhedronGraph(body, limit - 1e-6, planning::Spanning::kUniform).vertex_count(), 1);
  EXPECT_EQ(PolyhedronGraph(body, limit + 1e-6, planning::Spanning::kUniform).candidate_count(), 0);
  PolyhedronGraph above(body, limit + 0.2, planning::Spanning::kAdaptive);
  ASSERT_EQ(above.vertex_count(), 1);
  EXPECT_NEAR(above.cells().front().tangent, std::tan(limit), 1e-9);
  EXPECT_LE(above.cells().front().tangent, std::tan(limit));
}

TEST(PolyhedronGraph, OfBoxesIsEmpty) {
  for (const planning::Spanning spanning : kBothSpannings) {
    for (const Vector3d& size : {Vector3d(1, 1, 1), Vector3d(1, 2, 5)}) {
      const PolyhedronGraph graph(Box(size), Radians(15), spanning);
      EXPECT_EQ(graph.candidate_count(), 0);
      EXPECT_EQ(graph.vertex_count(), 0);
      EXPECT_EQ(graph.components().count(), 0);
    }
  }
}

TEST(PolyhedronGraph, OfARegularOctahedronIsTwoTetrahedraOfFaces) {
  const object::Polyhedron body = RegularOctahedron();
  PolyhedronGraph graph(body, Radians(10), planning::Spanning::kUniform);
  EXPECT_EQ(graph.candidate_count(), 2);
  ASSERT_EQ(graph.vertex_count(), 2);
  EXPECT_TRUE(graph.switches().empty());
  EXPECT_EQ(graph.components().count(), 2);
  for (const FocusCell& cell : graph.cells()) {
    EXPECT_TRUE(Contains(graph, cell, Vector3d::Zero()));
    for (const FaceIndex a : cell.faces) {
      for (const FaceIndex b : cell.faces) {
        if (a == b) continue;
        EXPECT_NEAR(body.inward_normal(FaceIndex(a)).dot(body.inward_normal(FaceIndex(b))),
                    -1.0 / 3, 1e-12);
      }
    }
  }
}

TEST(PolyhedronGraph, OfATetrahedronWithoutItsTipHasNoGraspWithTheCut) {
  // Three sides are inclined inwards over the bottom. With the cut face instead of the bottom, all
  // normals point down.
  std::vector<Eigen::Vector2d> base;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3 + 0.3;
    base.emplace_back(std::cos(angle), std::sin(angle));
  }
  // The height of a regular tetrahedron is √2; a third of it remains.
  const object::Polyhedron body = Frustum({base}, std::sqrt(2.0) / 3, 2.0 / 3);
  ASSERT_EQ(body.face_count(), 5);
  const PolyhedronGraph graph(body, Radians(10), planning::Spanning::kUniform);
  EXPECT_EQ(graph.candidate_count(), 1);
  ASSERT_EQ(graph.vertex_count(), 1);
  for (const FaceIndex face : graph.cells().front().faces) {
    EXPECT_GT(body.inward_normal(FaceIndex(face)).z(), -0.5);
  }
}

TEST(PolyhedronGraph, OfATetrahedronCutAtAllCornersHasTheSmallFacesTetrahedronToo) {
  object::PolygonSoup soup;
  const Vector3d corners[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  // Corner i is cut off at a third of the edge to each j. The vertex there is 3 i + (position of j
  // among the remaining corners).
  const auto vertex = [](int i, int j) { return 3 * i + (j < i ? j : j - 1); };
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (j != i) soup.vertices.push_back((2 * corners[i] + corners[j]) / 3);
    }
  }
  const std::array<std::array<int, 3>, 4> faces = {{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  for (const auto& [a, b, c] : faces) {
    soup.facets.push_back(
        {vertex(a, b), vertex(b, a), vertex(b, c), vertex(c, b), vertex(c, a), vertex(a, c)});
  }
  // Around corner 0 the faces are in the order of edges 1, 2, 3; around the remaining corners as
  // listed.
  const std::array<std::array<int, 3>, 4> around = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  for (int i = 0; i < 4; ++i) {
    const auto& [a, b, c] = around[i];
    soup.facets.push_back({vertex(i, a), vertex(i, b), vertex(i, c)});
  }
  const object::Polyhedron body = object::Polyhedron::FromSoup(soup, "truncated tetrahedron");
  ASSERT_EQ(body.face_count(), 8);
  PolyhedronGraph graph(body, Radians(10), planning::Spanning::kUniform);
  EXPECT_EQ(graph.candidate_count(), 2);
  ASSERT_EQ(graph.vertex_count(), 2);
  EXPECT_TRUE(graph.switches().empty());
  for (const FocusCell& cell : graph.cells()) {
    EXPECT_TRUE(Contains(graph, cell, Vector3d::Zero()));
    for (const FaceIndex f : cell.faces) {
      EXPECT_NEAR(body.face_measure(f), body.face_measure(cell.faces.front()), 1e-12);
    }
  }
}

/// Make a regular tetrahedron whose bottom is a roof.
///
/// Its ridge connects a corner with a point in the plane of the opposite side, `drop` times that
/// side's height below the bottom edge.
object::Polyhedron TetrahedronOverRoof(double drop) {
  const double half_edge = std::sqrt(3.0) / 2;
  const Vector3d a(-half_edge, -0.5, 0), b(half_edge, -0.5, 0), c(0, 1, 0);
  const Vector3d apex(0, 0, std::sqrt(2.0));
  const Vector3d middle = (a + b) / 2;
  const Vector3d low = middle + drop * (middle - apex);
  return object::Polyhedron::FromSoup(
      {{a, b, c, apex, low}, {{0, 4, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 4}, {1, 4, 2}}},
      "roofed tetrahedron");
}

TEST(PolyhedronGraph, TwoHalvesOfABottomAreLinkedWhereAFocusPointSeesBoth) {
  const object::Polyhedron body = TetrahedronOverRoof(0.05);
  ASSERT_EQ(body.face_count(), 5);
  PolyhedronGraph graph(body, Radians(10), planning::Spanning::kUniform);
  EXPECT_EQ(graph.candidate_count(), 2);
  ASSERT_EQ(graph.vertex_count(), 2);
  ASSERT_EQ(graph.switches().size(), 1U);
  EXPECT_EQ(graph.components().count(), 1);
  std::vector<int> neighbours;
  graph.GetNeighbours(0, neighbours);
  EXPECT_EQ(neighbours, std::vector{1});
  graph.GetNeighbours(1, neighbours);
  EXPECT_EQ(neighbours, std::vector{0});
  // A point in the mirror plane, above the ridge, sees all five.
  const Vector3d x(0, 0, 0.35);
  EXPECT_TRUE(Contains(graph, graph.cells()[0], x));
  EXPECT_TRUE(Contains(graph, graph.cells()[1], x));
}

TEST(PolyhedronGraph, RefusesAnglesThatAreNone) {
  for (const double degrees : {0.0, -10.0, 90.0, 180.0, std::nan("")}) {
    EXPECT_THROW(
        PolyhedronGraph(RegularTetrahedron(), Radians(degrees), planning::Spanning::kUniform),
        std::invalid_argument);
  }
}

TEST(Stone, HasAsManyFacesAsAskedFor) {
  for (const int faces : {6, 20, 47, 150}) {
    EXPECT_EQ(MakeStone(faces, {1, 1, 1}, 1).face_count(), faces);
    EXPECT_EQ(MakeStone(faces, {2.5, 1, 0.6}, 2).face_count(), faces);
  }
}

}  // namespace known_answers_test
}  // namespace regrasp::polyhedron
