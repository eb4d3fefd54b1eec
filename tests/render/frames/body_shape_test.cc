#include "render/frames/body_shape.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/object/polygon_soup.h"
#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace body_shape_test {

using Eigen::Vector3d;

TEST(BodyShapeTest, IsTheRealSolidInUnitsOfItsDiameter) {
  const object::Polyhedron block = MakeThinLBlock();
  const BodyShape shape = MakeBodyShape(block);
  const double unit = std::pow(block.diameter(), 3);
  EXPECT_NEAR(Volume(shape.surface) * unit, block.mass_properties().volume, 1e-12);
  EXPECT_EQ(shape.edges.size(), 18U);  // a prism of six sides, without edges inside a face
}

TEST(BodyShapeTest, APolygonWithAHoleBecomesAClosedPrism) {
  const object::Polygon polygon = object::Polygon::FromWkt(
      "POLYGON((0 0, 3 0, 3 4, 0 4, 0 0), (1 1, 2 1, 2 2, 1 1))", "polygon");
  const BodyShape shape = MakeBodyShape(polygon);
  // Diameter 5, thickness a quarter of it: area (12 − 0.5) / 25 times 0.25.
  EXPECT_NEAR(Volume(shape.surface), 11.5 / 25 * 0.25, 1e-12);
  Vector3d flux = Vector3d::Zero();
  for (const auto& [a, b, c] : shape.surface.triangles) flux += (b - a).cross(c - a);
  EXPECT_LT(flux.norm(), 1e-12);
}

TEST(BodyShapeTest, APrismHasTheRequestedThicknessAndItsTopAtTheContactPlane) {
  const object::Polygon square =
      object::Polygon::FromWkt("POLYGON((0 0, 3 0, 3 4, 0 4, 0 0))", "rectangle");
  for (const double thickness : {0.02, 0.25, 2.0}) {
    double low = 0, high = -1;
    for (const auto& corners : MakeBodyShape(square, {.thickness = thickness}).surface.triangles) {
      for (const Vector3d& p : corners) {
        low = std::min(low, p.z());
        high = std::max(high, p.z());
      }
    }
    EXPECT_NEAR(high - low, thickness, 1e-12);
    EXPECT_GT(high, 0);
    EXPECT_LT(high, 0.01);
  }
}

TEST(BodyShapeTest, RaysInThePlaneOfTheContactsMeetThePrismsWalls) {
  const object::Polygon frame = object::Polygon::FromWkt(
      "POLYGON((-2 -2, 2 -2, 2 2, -2 2, -2 -2), (-1 -1, -1 1, 1 1, 1 -1, -1 -1))", "frame");
  const BodyShape shape = MakeBodyShape(frame);
  const double half = 1 / frame.diameter();
  int met = 0;
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0)}) {
    EXPECT_NEAR(shape.rays.Distance(-half * direction, direction, 1e-4), 2 * half, 1e-12);
    ++met;
  }
  EXPECT_EQ(met, 3);
}

/// Return a prism with `sides` sides, radius 1 and height 0.5.
object::Polyhedron MakeRoundPrism(int sides) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < sides; ++i) {
    const double turn = Radians(360.0 * i / sides);
    outline.push_back({std::cos(turn), std::sin(turn)});
  }
  return object::Polyhedron::FromSoup(Extrude(outline, 0, 0.5), "prism");
}

TEST(BodyShapeTest, EdgesAreBendsAboveTheCreaseAngle) {
  const object::Polyhedron prism = MakeRoundPrism(12);  // walls at 30° to each other
  const auto edges = [&](EdgeStyle style, double degrees) {
    const BodyOptions options = {.edges = style, .crease_angle = Radians(degrees)};
    return MakeBodyShape(prism, options).edges.size();
  };
  EXPECT_EQ(edges(EdgeStyle::kCrease, 40), 24U);
  EXPECT_EQ(edges(EdgeStyle::kCrease, 29), 36U);
  EXPECT_EQ(edges(EdgeStyle::kAll, 40), 36U);
  EXPECT_EQ(edges(EdgeStyle::kNone, 1), 0U);
}

TEST(BodyShapeTest, IsShadedSmoothlyButAcrossCreases) {
  const BodyShape smooth = MakeBodyShape(MakeRoundPrism(12));
  int round = 0;
  for (std::size_t i = 0; i < smooth.surface.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vector3d& n = smooth.surface.normals[i][corner];
      const Vector3d& p = smooth.surface.triangles[i][corner];
      const Eigen::Vector2d outward = p.head<2>().normalized();
      if (std::abs(n.z()) > 0.5) {
        EXPECT_NEAR(std::abs(n.z()), 1, 1e-12);
        continue;
      }
      // The mean is area-weighted, so that the two triangles of a wall tilt it slightly.
      EXPECT_GT(n.head<2>().dot(outward), std::cos(Radians(6)));
      ++round;
    }
  }
  EXPECT_EQ(round, 12 * 2 * 3);
}

TEST(BodyShapeTest, LeavesOutScratchesAndKeepsLoops) {
  // A block with a roof whose ridge ends in the middle: 45° on one side only.
  object::PolygonSoup soup;
  const double size = 10;
  soup.vertices = {{0, 0, 0},    {size, 0, 0},    {size, size, 0}, {0, size, 0}, {0, 0, 5},
                   {size, 0, 5}, {size, size, 5}, {0, size, 5},    {4.5, 5, 5},  {5.5, 5, 5},
                   {5, 4.7, 5},  {5, 5.3, 5},     {5, 5, 5.4}};
  soup.facets = {{0, 3, 2, 1},
                 {0, 1, 5, 4},
                 {1, 2, 6, 5},
                 {2, 3, 7, 6},
                 {3, 0, 4, 7},
                 // The top around a small hill whose sides are steeper than 40°.
                 {4, 5, 10},
                 {4, 10, 8},
                 {5, 9, 10},
                 {5, 6, 9},
                 {6, 11, 9},
                 {6, 7, 11},
                 {7, 8, 11},
                 {7, 4, 8},
                 {8, 10, 12},
                 {10, 9, 12},
                 {9, 11, 12},
                 {11, 8, 12}};
  const BodyShape hill = MakeBodyShape(object::Polyhedron::FromSoup(soup, "hill"));
  EXPECT_EQ(hill.edges.size(), 12U + 4 + 4) << "a small hill has a loop around its foot";
  // The same creases without the loop: the foot is smooth, and the ridge is a short tree.
  soup.vertices[12].z() = 5.24;
  const BodyOptions sharp = {.crease_angle = Radians(50)};
  const BodyShape flat = MakeBodyShape(object::Polyhedron::FromSoup(soup, "hill"), sharp);
  EXPECT_EQ(flat.edges.size(), 12U);
}

/// Return a polyhedron around a sphere with a ridge: its equator is a sharp edge.
object::Polyhedron MakeLens(int sides, double height) {
  object::PolygonSoup soup;
  const auto ring = [&](double radius, double z, double offset) {
    for (int i = 0; i < sides; ++i) {
      const double turn = 2 * M_PI * (i + offset) / sides;
      soup.vertices.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
    }
  };
  constexpr int kRings = 8;
  for (int k = -kRings; k <= kRings; ++k) {
    const double share = static_cast<double>(std::abs(k)) / (kRings + 1);
    // The profile is a circular arc that meets its mirror image at an angle.
    ring(1 - share * share * 0.6 - share * 0.35, height * k / kRings, 0.5 * (k + kRings));
  }
  const int low = static_cast<int>(soup.vertices.size());
  soup.vertices.emplace_back(0, 0, -height * 1.05);
  soup.vertices.emplace_back(0, 0, height * 1.05);
  for (int k = 0; k < 2 * kRings; ++k) {
    for (int i = 0; i < sides; ++i) {
      const int a = k * sides + i, b = k * sides + (i + 1) % sides;
      // Rings are rotated by half a side relative to each other.
      soup.facets.push_back({a, b, a + sides});
      soup.facets.push_back({b, b + sides, a + sides});
    }
  }
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides, top = 2 * kRings * sides;
    soup.facets.push_back({low, next, i});
    soup.facets.push_back({low + 1, top + i, top + next});
  }
  return object::Polyhedron::FromSoup(soup, "lens");
}

TEST(BodyShapeTest, AScanHasNoCreasesButAnOutline) {
  const object::Polyhedron lens = MakeLens(24, 0.3);
  const BodyShape shape = MakeBodyShape(lens);
  EXPECT_TRUE(shape.edges.empty()) << "it bends at every edge, and sharply only at its equator";
  EXPECT_FALSE(FindOutline(shape, [](const Vector3d&) { return Vector3d(1, 0, 0); }).empty());
  EXPECT_LT(Volume(shape.shell), -Volume(shape.surface)) << "larger, and oriented inwards";
  EXPECT_TRUE(MakeBodyShape(lens, {.edges = EdgeStyle::kNone}).shell.triangles.empty());
  EXPECT_GT(MakeBodyShape(lens, {.edges = EdgeStyle::kAll}).edges.size(), 24U);
  // A cylinder with planar ends is not a scan.
  EXPECT_FALSE(MakeBodyShape(MakeRoundPrism(64)).edges.empty());
  EXPECT_TRUE(MakeBodyShape(MakeRoundPrism(64)).shell.triangles.empty());
}

/// Return the number of triangles with different normals at their corners.
int CountSmooth(const BodyShape& shape) {
  int count = 0;
  for (const auto& [a, b, c] : shape.surface.normals) {
    count += a.dot(b) < 1 - 1e-9 || b.dot(c) < 1 - 1e-9 ? 1 : 0;
  }
  return count;
}

TEST(BodyShapeTest, AScanIsShadedSmoothlyThroughoutAndACadModelUpToItsCreases) {
  // The lens bends by more than the crease angle at its equator.
  const BodyShape lens = MakeBodyShape(MakeLens(24, 0.6));
  double sharpest = 1;  // cosine
  for (const Fold& fold : lens.folds)
    sharpest = std::min(sharpest, fold.normals[0].dot(fold.normals[1]));
  EXPECT_LT(sharpest, std::cos(kDefaultCreaseAngle));
  EXPECT_EQ(CountSmooth(lens), static_cast<int>(lens.surface.triangles.size()));
  std::map<std::array<double, 3>, Vector3d> normals;
  for (std::size_t t = 0; t < lens.surface.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Vector3d& p = lens.surface.triangles[t][i];
      const Vector3d& n = lens.surface.normals[t][i];
      const auto [known, is_new] = normals.try_emplace({p.x(), p.y(), p.z()}, n);
      EXPECT_GT(known->second.dot(n), 1 - 1e-9) << "one normal per vertex";
    }
  }
  // Negative control: a cube has one normal per face.
  EXPECT_EQ(CountSmooth(MakeBodyShape(MakeThinLBlock())), 0);
}

TEST(BodyShapeTest, ConcaveEdgesAreNotPartOfAnOutline) {
  // The inner edge of the L is a fold and a crease, and the solid hides it from wherever it would
  // separate front and back.
  const BodyShape block = MakeBodyShape(MakeThinLBlock());
  EXPECT_EQ(block.edges.size(), 18U);
  EXPECT_EQ(block.folds.size(), 17U);
}

TEST(BodyShapeTest, TheOutlineOfARoundObjectSeparatesFrontAndBack) {
  const BodyShape body = MakeBodyShape(MakeRoundPrism(64), {.crease_angle = Radians(95)});
  EXPECT_TRUE(body.edges.empty());
  const auto outline = FindOutline(body, [](const Vector3d&) { return Vector3d(1, 0, 0); });
  int upright = 0;
  for (const auto& [a, b] : outline) {
    if (std::abs(a.z() - b.z()) < 1e-9) {
      EXPECT_GT(a.x() + b.x(), 0);  // rims at which a wall faces the eye
      continue;
    }
    EXPECT_LT(std::abs(a.x()), 0.05);
    ++upright;
  }
  EXPECT_EQ(upright, 2);
}

}  // namespace body_shape_test
}  // namespace regrasp::render
