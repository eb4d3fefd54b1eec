#include "planner/tree/surface_route.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/object/polygon.h"
#include "planner/plan/check_step.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
namespace surface_route_test {

using Eigen::Vector3d;

grasp::Contact On(const object::Object& object, const Vector3d& near) {
  const FaceIndex face = object.FacesNear(near, object.diameter()).front();
  return {object.ClosestPoint(face, near), object.inward_normal(face), face};
}

/// Expect that every segment is a motion that a plan may contain.
void ExpectLegal(const object::Object& object, const SurfaceRoute& route) {
  ASSERT_EQ(route.size() % 2, 0u);
  for (std::size_t i = 1; i < route.size(); ++i) {
    EXPECT_EQ(plan::FindMotionFault(object, route[i - 1], route[i]), std::nullopt);
  }
}

/// Return the length of the shortest path over one edge, over all its points, with straight
/// segments.
double ShortestOver(const object::FaceBorder& edge, const Vector3d& p, const Vector3d& q) {
  constexpr int kPoints = 20'000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kPoints; ++i) {
    const Vector3d at = edge.a + static_cast<double>(i) / kPoints * (edge.b - edge.a);
    least = std::min(least, (p - at).norm() + (at - q).norm());
  }
  return least;
}

TEST(SurfaceRoute, OverOneEdgeOfACubeIsTheShortestWay) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const object::Object& cube = *file.object;
  const sampling::SurfaceSampler source(cube);
  RandomStream random(1, RandomUse::kStart);
  int over_edges = 0;
  for (int i = 0; i < 200; ++i) {
    const grasp::Contact from = source.Draw(random);
    const grasp::Contact to = source.Draw(random);
    if (!cube.AreNeighbours(from.face, to.face)) continue;
    const auto route = FindSurfaceRoute(cube, from, to);
    ASSERT_TRUE(route);
    ExpectLegal(cube, *route);
    EXPECT_GE(LengthOf(*route), (from.p - to.p).norm());
    const auto back = FindSurfaceRoute(cube, to, from);
    ASSERT_TRUE(back);
    if (route->size() != 4 || back->size() != 4) continue;
    ++over_edges;
    EXPECT_NEAR(LengthOf(*back), LengthOf(*route), 1e-12);
    for (const object::FaceBorder& edge : cube.BordersOf(from.face)) {
      if (edge.beyond != to.face) continue;
      // Resolution of the grid of the independent search, and of the omitted corners.
      const double accuracy = 1e-3 * cube.diameter();
      EXPECT_NEAR(LengthOf(*route), ShortestOver(edge, from.p, to.p), accuracy);
    }
  }
  EXPECT_GT(over_edges, 50);
}

TEST(SurfaceRoute, OnOneFaceIsStraight) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const sampling::SurfaceSampler source(*file.object);
  RandomStream random(2, RandomUse::kStart);
  const grasp::Contact from = source.Draw(random);
  const grasp::Contact to = source.DrawOn(from.face, random);
  const auto route = FindSurfaceRoute(*file.object, from, to);
  ASSERT_TRUE(route);
  ASSERT_EQ(route->size(), 2u);
  EXPECT_EQ(LengthOf(*route), (from.p - to.p).norm());
}

TEST(SurfaceRoute, GoesOverSeveralTrianglesOfAMesh) {
  const object::ObjectFile file = ReadModel("ellipsoid1000.obj");
  const object::Object& body = *file.object;
  const sampling::SurfaceSampler source(body);
  RandomStream random(3, RandomUse::kStart);
  int longest = 0;
  for (int i = 0; i < 100; ++i) {
    const grasp::Contact from = source.Draw(random);
    const grasp::Contact to = source.DrawAround(from, 0.06 * body.diameter(), random);
    const auto route = FindSurfaceRoute(body, from, to);
    if (!route) continue;
    ExpectLegal(body, *route);
    // On such a smooth object the path along the surface is only slightly longer than the straight
    // line.
    EXPECT_LT(LengthOf(*route), 1.2 * (from.p - to.p).norm() + 1e-3 * body.diameter());
    longest = std::max(longest, static_cast<int>(route->size()));
  }
  EXPECT_EQ(longest, 2 * (RouteLimits{}.crossings + 1));
}

TEST(SurfaceRoute, NeverGoesThroughAConcaveEdge) {
  // L-shaped polygon with its concave corner at (1, 1).
  const object::Polygon ell =
      object::Polygon::FromWkt("POLYGON((0 0, 3 0, 3 1, 1 1, 1 3, 0 3, 0 0))", "ell");
  const grasp::Contact low = On(ell, {2, 1, 0});
  const grasp::Contact high = On(ell, {1, 2, 0});
  ASSERT_TRUE(ell.AreNeighbours(low.face, high.face));
  EXPECT_FALSE(FindSurfaceRoute(ell, low, high));
  // The neighbouring convex corners can be passed.
  EXPECT_TRUE(FindSurfaceRoute(ell, low, On(ell, {3, 0.5, 0})));
  EXPECT_TRUE(FindSurfaceRoute(ell, On(ell, {0.5, 3, 0}), high));
}

TEST(SurfaceRoute, GoesThroughAConcaveEdgeWhereItsTurnIsAllowed) {
  // The top has a bend in the middle by 2 atan(0.1 / 2), 5.7° or 0.0999 radians.
  const object::Polygon roof =
      object::Polygon::FromWkt("POLYGON((0 0, 4 0, 4 2, 2 1.9, 0 2, 0 0))", "roof");
  const grasp::Contact right = On(roof, {3, 1.95, 0});
  const grasp::Contact left = On(roof, {1, 1.95, 0});
  ASSERT_TRUE(roof.AreNeighbours(right.face, left.face));
  EXPECT_FALSE(FindSurfaceRoute(roof, right, left));
  EXPECT_FALSE(FindSurfaceRoute(roof, right, left, {.concave = 0.099}));
  const auto route = FindSurfaceRoute(roof, right, left, {.concave = 0.101});
  ASSERT_TRUE(route);
  ExpectLegal(roof, *route);
  EXPECT_EQ(route->size(), 4u);
  EXPECT_NEAR(LengthOf(*route), 2 * std::hypot(1, 0.05), 1e-12);
  EXPECT_FALSE(FindSurfaceRoute(roof, right, left, {.crossings = 0, .concave = 0.101}));
}

TEST(SurfaceRoute, GoesRoundTheConcaveEdgeOfABlockOverItsCaps) {
  const object::ObjectFile file = ReadModel("l_block.obj");
  const object::Object& block = *file.object;
  int concave = 0;
  for (FaceIndex face{0}; face < block.face_count(); ++face) {
    for (const object::FaceBorder& edge : block.BordersOf(face)) {
      if (edge.convex) continue;
      ++concave;
      const Vector3d middle = (edge.a + edge.b) / 2;
      const double off = 0.05 * block.diameter();
      // Moves off the edge follow the other face's outward normal.
      const Vector3d n = block.inward_normal(face);
      const Vector3d m = block.inward_normal(edge.beyond);
      const grasp::Contact from{block.ClosestPoint(face, middle - off * m), n, face};
      const grasp::Contact to{block.ClosestPoint(edge.beyond, middle - off * n), m, edge.beyond};
      const auto route = FindSurfaceRoute(block, from, to);
      if (!route) continue;
      ExpectLegal(block, *route);
      EXPECT_GT(route->size(), 4u) << "not over the concave edge itself";
    }
  }
  EXPECT_EQ(concave, 2) << "one edge, seen from both sides";
}

}  // namespace surface_route_test
}  // namespace regrasp::tree
