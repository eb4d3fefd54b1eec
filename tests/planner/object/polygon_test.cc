#include "planner/object/polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "planner/base/error.h"

namespace regrasp::object {
namespace polygon_test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kTight = 1e-12;

constexpr std::string_view kFrame =
    "POLYGON((0 0, 4 0, 4 2, 0 2, 0 0), (1 0.5, 3 0.5, 3 1.5, 1 1.5, 1 0.5))";

TEST(Polygon, MaterialIsOnTheLeftOfOutlineAndHoles) {
  const Polygon frame = Polygon::FromWkt(kFrame, "frame");
  ASSERT_EQ(frame.face_count(), 8);
  for (FaceIndex f{0}; f < 8; ++f) {
    const auto [a, b] = frame.edge(f);
    const Vector3d n = frame.inward_normal(f);
    EXPECT_NEAR(n.norm(), 1, kTight);
    EXPECT_NEAR(n.dot(b - a), 0, kTight);
    const Vector3d inside = (a + b) / 2 + 0.1 * n;
    const bool in_outline = inside.x() > 0 && inside.x() < 4 && inside.y() > 0 && inside.y() < 2;
    const bool in_hole = inside.x() > 1 && inside.x() < 3 && inside.y() > 0.5 && inside.y() < 1.5;
    EXPECT_TRUE(in_outline && !in_hole) << "edge " << f;
  }
  EXPECT_NEAR(frame.diameter(), std::sqrt(20), kTight);
}

TEST(Polygon, EdgesMeetAtTheirVerticesAndOnlyThoseOfTheHoleAreConcave) {
  const Polygon frame = Polygon::FromWkt(kFrame, "frame");
  for (FaceIndex f{0}; f < 8; ++f) {
    const auto [a, b] = frame.edge(f);
    const auto borders = frame.BordersOf(f);
    ASSERT_EQ(borders.size(), 2u);
    EXPECT_EQ(borders[0].a, a);
    EXPECT_EQ(borders[0].b, a);
    EXPECT_EQ(borders[1].a, b);
    for (const FaceBorder& border : borders) {
      EXPECT_EQ(border.convex, f < 4) << "edge " << f;
      EXPECT_EQ(border.beyond < 4, f < 4);
      EXPECT_TRUE(frame.AreNeighbours(f, border.beyond));
      EXPECT_TRUE(frame.AreNeighbours(border.beyond, f));
    }
    EXPECT_NE(borders[0].beyond, borders[1].beyond);
    EXPECT_FALSE(frame.AreNeighbours(f, f));
    EXPECT_FALSE(frame.AreNeighbours(f, FaceIndex((f + 4) % 8)));
  }
  // Collinear edges are returned, too.
  const Polygon split = Polygon::FromWkt("POLYGON((0 0, 1 0, 2 0, 2 2, 0 2, 0 0))", "split");
  EXPECT_TRUE(split.BordersOf(FaceIndex(0)).back().convex);
}

TEST(Polygon, MassPropertiesAreThoseOfARectangleLessItsHole) {
  const Polygon frame = Polygon::FromWkt(kFrame, "frame");
  const MassProperties mass = frame.mass_properties();
  EXPECT_NEAR(mass.volume, 8 - 2, kTight);
  EXPECT_NEAR((mass.centroid - Vector3d(2, 1, 0)).norm(), 0, kTight);
  // b h³/12 about x, h b³/12 about y; both rectangles have the same centre.
  const double about_x = (4 * 8 - 2 * 1) / 12.0, about_y = (2 * 64 - 1 * 8) / 12.0;
  EXPECT_NEAR(mass.inertia(0, 0), about_x, kTight);
  EXPECT_NEAR(mass.inertia(1, 1), about_y, kTight);
  EXPECT_NEAR(mass.inertia(2, 2), about_x + about_y, kTight);
  EXPECT_NEAR(mass.inertia(0, 1), 0, kTight);
}

TEST(Polygon, MassPropertiesTurnAndMoveWithThePolygon) {
  const std::vector<Vector2d> ring = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {0, 2}};
  const Vector2d shift(-7, 11);
  const double angle = 0.8;
  const Eigen::Rotation2Dd turn(angle);
  std::vector<Vector2d> moved;
  for (const auto& p : ring) moved.push_back(turn * p + shift);
  const MassProperties before = Polygon::FromRings({ring}, "a").mass_properties();
  const MassProperties after = Polygon::FromRings({moved}, "b").mass_properties();
  EXPECT_NEAR(after.volume, before.volume, kTight);
  const Vector2d centroid = turn * before.centroid.head<2>() + shift;
  EXPECT_NEAR((after.centroid.head<2>() - centroid).norm(), 0, kTight);
  const Eigen::Matrix3d r = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR((after.inertia - r * before.inertia * r.transpose()).norm(), 0, 1e-10);
}

TEST(Polygon, ClockwiseRingsAreTurnedAndKeepTheirFirstPoint) {
  const Polygon square = Polygon::FromRings({{{0, 0}, {0, 1}, {1, 1}, {1, 0}}}, "square");
  EXPECT_THAT(square.rings()[0],
              ElementsAre(Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)));
  EXPECT_NEAR((square.inward_normal(FaceIndex(0)) - Vector3d(0, 1, 0)).norm(), 0, kTight);
}

TEST(Polygon, CollinearNeighbouringEdgesStaySeparate) {
  const Polygon square = Polygon::FromWkt("POLYGON((0 0,1 0,2 0,2 2,0 2,0 0))", "square");
  EXPECT_EQ(square.face_count(), 5);
  EXPECT_THAT(square.FacesNear({1, 0, 0}, 1e-9), ElementsAre(0, 1));
  EXPECT_FALSE(square.ContainsSegment(FaceIndex(0), {0.5, 0, 0}, {1.5, 0, 0}, 1e-6));
  EXPECT_TRUE(square.ContainsSegment(FaceIndex(0), {0.5, 0, 0}, {1, 0, 0}, 1e-6));
}

TEST(Polygon, QueriesMeasureToTheEdge) {
  const Polygon frame = Polygon::FromWkt(kFrame, "frame");
  EXPECT_NEAR((frame.ClosestPoint(FaceIndex(0), {1, -3, 0}) - Vector3d(1, 0, 0)).norm(), 0, kTight);
  EXPECT_NEAR((frame.ClosestPoint(FaceIndex(0), {9, 1, 0}) - Vector3d(4, 0, 0)).norm(), 0, kTight);
  EXPECT_NEAR(frame.DistanceToBorder(FaceIndex(0), {1, 0, 0}), 1, kTight);
  EXPECT_NEAR(frame.face_measure(FaceIndex(0)), 4, kTight);
  EXPECT_THAT(frame.FacesNear({2, 0.1, 0}, 0.3), ElementsAre(0));
  EXPECT_EQ(frame.FacesNear({2, 0.1, 0}, 0.45).size(), 2u);
  EXPECT_TRUE(frame.FacesNear({2, 0.1, 1}, 0.3).empty()) << "off the plane";
}

TEST(Polygon, AnEdgeWhoseSquaredLengthUnderflowsIsRefusedAndALongerOneIsNot) {
  for (const double length : {1e-310, 1e-162, 1e-31}) {
    EXPECT_THROW(static_cast<void>(
                     Polygon::FromRings({{{0, 0}, {length, 0}, {1, 1}, {0, 1}}}, "underflow.wkt")),
                 InputError);
  }
  const Polygon polygon = Polygon::FromRings({{{0, 0}, {1e-29, 0}, {1, 1}, {0, 1}}}, "short.wkt");
  EXPECT_EQ(polygon.ClosestPoint(FaceIndex(0), {-0.3, 0.4, 0}), Vector3d(0, 0, 0));
  EXPECT_THAT(polygon.FacesNear({0, 0, 0}, 1e-9), ElementsAre(0, 3, 1));
}

TEST(Polygon, WktIsReadInAnyCaseAndLayout) {
  for (const std::string_view text :
       {"POLYGON((0 0,1 0,1 1,0 0))", "polygon ((0 0, 1 0, 1 1, 0 0))",
        "  Polygon\n(\t(\r\n0   0 ,1 0,\n1.0e0 +1,0 0 )\n)\n\n",
        "MultiPolygon(((0 0,1 0,1 1,0 0)))", "\xEF\xBB\xBFPOLYGON((0 0,1 0,1 1,-0 0))"}) {
    const Polygon triangle = Polygon::FromWkt(text, "text");
    EXPECT_EQ(triangle.face_count(), 3) << text;
    EXPECT_NEAR(triangle.mass_properties().volume, 0.5, kTight) << text;
  }
}

struct BadWkt {
  std::string text;
  std::string words;  ///< words that the message must contain
};

TEST(Polygon, BadWktIsRefusedWithRingAndVertex) {
  const std::vector<BadWkt> cases = {
      {"", "expected POLYGON"},
      {"POINT(0 0)", "\"point\", expected POLYGON"},
      {"POLYGON", "truncated, expected \"(\""},
      {"POLYGON EMPTY", "empty"},
      {"MULTIPOLYGON EMPTY", "empty"},
      {"MULTIPOLYGON(EMPTY)", "empty"},
      {"POLYGON(EMPTY)", "ring 0: empty"},
      {"POLYGON()", "ring 0"},
      {"POLYGON(())", "ring 0: vertex 0: expected a finite number, found \"\""},
      {"POLYGON Z((0 0 0,1 0 0,1 1 0,0 0 0))", "\"z\", expected"},
      {"POLYGON((0 0 0,1 0 0,1 1 0,0 0 0))",
       "ring 0: vertex 0: expected two coordinates, found more"},
      {"POLYGON((0 0,1 nan,1 1,0 0))", "ring 0: vertex 1: expected a finite number, found \"nan\""},
      {"POLYGON((0 0,1 0,1 inf,0 0))", "ring 0: vertex 2: expected a finite number, found \"inf\""},
      {"POLYGON((0 0,1 0,1 1e999,0 0))",
       "ring 0: vertex 2: expected a finite number, found \"1e999\""},
      {"POLYGON((0 0,1 0,1 1e16,0 0))", "ring 0: vertex 2: the coordinate 1e+16"},
      {"POLYGON((0,0 1,0 1,1 0,0))", "ring 0: vertex 0"},
      {"POLYGON((0 0,1 0,1 1))", "ring 0: not closed"},
      {"POLYGON((0 0))", "ring 0: not closed"},
      {"POLYGON((0 0,0 0))", "ring 0: expected at least 3"},
      {"POLYGON((0 0,1 0,0 0))", "ring 0: expected at least 3"},
      {"POLYGON((0 0,1 0,1 0,1 1,0 0))", "ring 0: vertex 2: repeats vertex 1"},
      {"POLYGON((0 0,1 0,1 1,0 0,0 0))", "ring 0: vertex 3: repeats vertex 0"},
      {"POLYGON((0 0,2 0,1 1,2 2,0 2,1 1,0 0))", "ring 0: vertex 5: repeats vertex 2"},
      {"POLYGON((0 0,2 2,2 0,0 2,0 0))", "ring 0: edge 0: self-intersecting: meets ring 0: edge 2"},
      {"POLYGON((0 0,3 0,1 0,1 1,0 0))", "self-intersecting"},
      {"POLYGON((0 0,1 0,2 0,0 0))", "self-intersecting"},
      {"POLYGON((0 0,4 0,4 4,0 4,0 0),(1 1,5 1,2 3,1 1))", "self-intersecting: meets ring 1"},
      {"POLYGON((0 0,4 0,4 4,0 4,0 0),(0 1,2 1,2 3,0 1))", "self-intersecting: meets ring 1"},
      {"POLYGON((0 0,4 0,4 4,0 4,0 0),(6 1,7 1,7 3,6 1))", "ring 1: hole outside"},
      {"POLYGON((0 0,4 0,4 4,0 4,0 0),(1 1,3 1,3 3,1 3,1 1),(2 2,2.5 2,2.5 2.5,2 2))",
       "ring 2: hole inside another hole, ring 1"},
      {"POLYGON((0 0,4 0,4 4,0 4,0 0),(2 2,2.5 2,2.5 2.5,2 2),(1 1,3 1,3 3,1 3,1 1))",
       "ring 1: hole inside another hole, ring 2"},
      {"POLYGON((0 0,4 0,4 4,0 4,0 0),(1 1,2 1,2 2,1 1),(2 2,3 2,3 3,2 2))",
       "self-intersecting: meets ring 2"},
      {"POLYGON((0 0,1 0,1 1,0 0)", "truncated, expected \")\""},
      {"POLYGON((0 0,1 0,1 1,0 0)) x", "expected the end after the polygon, found \"x\""},
      {"POLYGON((0 0,1 0,1 1,0 0)))", "after the polygon"},
      {std::string("POLYGON((0 0,1 0,1 1,0 0))\0", 27), "after the polygon"},
      {"MULTIPOLYGON(((0 0,1 0,1 1,0 0)),((5 5,6 5,6 6,5 5)))",
       "expected a MULTIPOLYGON of one polygon"},
      {"POLYGON((0 0,1e-17 0,0 1e-17,0 0))", "within 1e-15"},
      {"POLYGON((1e9 0,1000000001 0,1e9 1,1e9 0))", "too far from the origin"},
  };
  for (const auto& [text, words] : cases) {
    try {
      const Polygon polygon = Polygon::FromWkt(text, "bad.wkt");
      ADD_FAILURE() << "read " << text << " with " << polygon.face_count() << " edges";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("bad.wkt: ")) << text;
      EXPECT_THAT(error.what(), HasSubstr(words)) << text;
    }
  }
}

TEST(Polygon, PredicatesAreExact) {
  // The third point is off the line through the two others by less than a typical tolerance.
  const double up = std::nextafter(0.1, 1);
  const Polygon sliver = Polygon::FromRings({{{0, 0}, {1, 1}, {0.1, up}}}, "sliver");
  EXPECT_GT(sliver.mass_properties().volume, 0);
  EXPECT_THROW(static_cast<void>(Polygon::FromRings({{{0, 0}, {1, 1}, {0.1, 0.1}}}, "flat")),
               InputError);
}

TEST(Polygon, APolygonOfManyEdgesIsRead) {
  std::vector<Vector2d> ring;
  constexpr int kEdges = 20000;
  for (int i = 0; i < kEdges; ++i) {
    const double angle = 2 * std::numbers::pi * i / kEdges;
    ring.emplace_back(std::cos(angle), std::sin(angle));
  }
  const Polygon disc = Polygon::FromRings({ring}, "disc");
  EXPECT_EQ(disc.face_count(), kEdges);
  EXPECT_NEAR(disc.diameter(), 2, 1e-9);
  EXPECT_NEAR(disc.mass_properties().volume, std::numbers::pi, 1e-6);
}

}  // namespace polygon_test
}  // namespace regrasp::object
