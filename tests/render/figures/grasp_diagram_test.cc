#include "render/figures/grasp_diagram.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace grasp_diagram_test {

using Eigen::Vector2d;

/// Tolerance of coordinates of objects of size 1: invisible on a page and far above rounding
/// errors.
constexpr double kClose = 1e-9;
/// Tolerance if cones are drawn at φ*, since the computation uses cones that are narrower by 1e-9.
constexpr double kCloseAtLimit = 1e-6;

const double kHeight = std::sqrt(3.0) / 2;

grasp::Grasp MiddleOfTriangle() {
  const object::Polygon triangle = MakeTriangle();
  return {OnEdge(triangle, 0, 0.5), OnEdge(triangle, 1, 0.5), OnEdge(triangle, 2, 0.5)};
}

grasp::Grasp OnSquare(const std::vector<std::pair<int, double>>& places) {
  grasp::Grasp grasp;
  for (const auto& [edge, u] : places) grasp.push_back(OnEdge(MakeSquare(), edge, u));
  return grasp;
}

bool IsInside(const Outline& outline, const Vector2d& p) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d along = outline[(i + 1) % outline.size()] - outline[i];
    const Vector2d reach = p - outline[i];
    if (along.x() * reach.y() - along.y() * reach.x() < 0) return false;
  }
  return true;
}

/// Return the part that contains `p`; nullptr if there is none.
const Outline* PartWith(const std::vector<Outline>& cell, const Vector2d& p) {
  const auto part =
      std::find_if(cell.begin(), cell.end(), [&](const Outline& o) { return IsInside(o, p); });
  return part == cell.end() ? nullptr : &*part;
}

double AngleBetween2d(const Vector2d& a, const Vector2d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
}

TEST(GraspDiagramTest, AnEquilateralTriangleHeldInTheMiddlesHasItsFocusAtTheCentroid) {
  for (const double degrees : {5.0, 20.0, 29.0, 30.0, 45.0, 80.0}) {
    const GraspDiagram diagram =
        DescribeGrasp(MakeTriangle(), MiddleOfTriangle(), Radians(degrees));
    ASSERT_EQ(diagram.kind, DiagramKind::kConcurrent) << degrees;
    ASSERT_TRUE(diagram.focus);
    EXPECT_LT((*diagram.focus - Vector2d(0.5, kHeight / 3)).norm(), kCloseAtLimit) << degrees;
  }
}

TEST(GraspDiagramTest, TheFocusMovesWithTheContacts) {
  const object::Polygon triangle = MakeTriangle();
  const grasp::Grasp grasp = {OnEdge(triangle, 0, 0.6), OnEdge(triangle, 1, 0.5),
                              OnEdge(triangle, 2, 0.5)};
  const GraspDiagram diagram = DescribeGrasp(triangle, grasp, Radians(20));
  ASSERT_TRUE(diagram.focus);
  EXPECT_GT(diagram.focus->x(), 0.5 + kClose);
}

TEST(GraspDiagramTest, ConesOfAConcurrentGraspAreNoWiderThanItsNormalsSpan) {
  const object::Polygon triangle = MakeTriangle();
  for (const auto& [friction, drawn] : {std::pair{20.0, 20.0}, {29.0, 29.0}, {45.0, 30.0}}) {
    const GraspDiagram diagram = DescribeGrasp(triangle, MiddleOfTriangle(), Radians(friction));
    ASSERT_EQ(diagram.cones.size(), 3U);
    for (const DoubleCone& cone : diagram.cones) {
      EXPECT_NEAR(Degrees(cone.friction_angle), drawn, kClose);
    }
  }
}

TEST(GraspDiagramTest, TheFocusLiesInEveryConeAndInTheCell) {
  const GraspDiagram diagram = DescribeGrasp(MakeTriangle(), MiddleOfTriangle(), Radians(12));
  for (const DoubleCone& cone : diagram.cones) {
    EXPECT_LT(AngleBetween2d(*diagram.focus - cone.apex, cone.axis), cone.friction_angle);
  }
  EXPECT_NE(PartWith(diagram.focus_cell, *diagram.focus), nullptr);
  EXPECT_EQ(PartWith(diagram.focus_cell, Vector2d(3, 3)), nullptr);
}

TEST(GraspDiagramTest, TheFocusCellOfATriangleHasTheExpectedCorners) {
  // Each edge is visible from every interior point. A point below the bottom edge sees this edge
  // between lines from its ends at θ to its normal. It sees the inner sides of the other two edges
  // between lines at θ to their normals. The lines at θ intersect on the axis of symmetry.
  const double theta = Radians(20);
  const GraspDiagram diagram = DescribeGrasp(MakeTriangle(), MiddleOfTriangle(), theta);
  const Outline* inner = PartWith(diagram.focus_cell, {0.5, kHeight / 3});
  ASSERT_NE(inner, nullptr);
  ASSERT_EQ(inner->size(), 3U);
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(1, 0), Vector2d(0.5, kHeight)}) {
    EXPECT_TRUE(std::any_of(inner->begin(), inner->end(),
                            [&](const Vector2d& p) { return (p - corner).norm() < kClose; }));
  }
  const Outline* below = PartWith(diagram.focus_cell, {0.5, -0.1});
  ASSERT_NE(below, nullptr);
  double lowest = 0;
  for (const Vector2d& p : *below) lowest = std::min(lowest, p.y());
  // At (0, 0) the border of the left edge's cones descends at 30° + θ below the x axis.
  EXPECT_NEAR(lowest, -0.5 * std::tan(Radians(30) + theta), kClose);
}

TEST(GraspDiagramTest, ContactsWithoutACommonPointAreNotConcurrent) {
  const object::Polygon triangle = MakeTriangle();
  const grasp::Grasp apart = {OnEdge(triangle, 0, 0.05), OnEdge(triangle, 1, 0.05),
                              OnEdge(triangle, 2, 0.05)};
  const GraspDiagram diagram = DescribeGrasp(triangle, apart, Radians(5));
  EXPECT_EQ(diagram.kind, DiagramKind::kOther);
  EXPECT_FALSE(diagram.focus);
  EXPECT_TRUE(diagram.focus_cell.empty());
  EXPECT_EQ(diagram.cones.size(), 3U);
}

TEST(GraspDiagramTest, NormalsThatDoNotSpanThePlaneAreNotConcurrent) {
  // Left, right and bottom of the square: no contact force points down.
  const GraspDiagram diagram =
      DescribeGrasp(MakeSquare(), OnSquare({{3, 0.5}, {1, 0.5}, {0, 0.5}}), Radians(10));
  EXPECT_NE(diagram.kind, DiagramKind::kConcurrent);
}

TEST(GraspDiagramTest, AParallelGraspOnParallelEdgesHasTheWholeConeInCommon) {
  const GraspDiagram diagram =
      DescribeGrasp(MakeSquare(), OnSquare({{0, 0.5}, {2, 0.25}, {2, 0.75}}), Radians(20));
  ASSERT_EQ(diagram.kind, DiagramKind::kParallel);
  ASSERT_EQ(diagram.cones.size(), 3U);
  for (const DoubleCone& cone : diagram.cones) {
    EXPECT_NEAR(Degrees(cone.friction_angle), 20, kClose);
    EXPECT_NEAR(cone.axis.x(), 0, kClose);
  }
  EXPECT_GT(diagram.cones[0].axis.y(), 0);
  EXPECT_LT(diagram.cones[1].axis.y(), 0);
  ASSERT_TRUE(diagram.force_direction);
  EXPECT_NEAR(diagram.force_direction->x(), 0, kClose);
}

TEST(GraspDiagramTest, ACommonConeIsNarrowerForInclinedEdges) {
  // The two upper edges are inclined to one side by 4° and 10°. Their common cone with the bottom
  // is the range from 10° − θ to θ from the vertical, and the three normals do not span the plane.
  const double first = std::tan(Radians(4));
  const double second = std::tan(Radians(10));
  const object::Polygon wedge = object::Polygon::FromRings(
      {{{-1, -1}, {1, -1}, {1, 1}, {0, 1 - first}, {-1, 1 - first - second}}}, "wedge");
  const grasp::Grasp grasp = {OnEdge(wedge, 0, 0.5), OnEdge(wedge, 2, 0.5), OnEdge(wedge, 3, 0.5)};
  const GraspDiagram diagram = DescribeGrasp(wedge, grasp, Radians(20));
  ASSERT_EQ(diagram.kind, DiagramKind::kParallel);
  for (const DoubleCone& cone : diagram.cones) {
    EXPECT_NEAR(Degrees(cone.friction_angle), 15, kClose);
    EXPECT_NEAR(Degrees(AngleBetween2d(cone.axis, Vector2d(0, cone.axis.y()))), 5, kClose);
  }
  EXPECT_EQ(DescribeGrasp(wedge, grasp, Radians(4.9)).kind, DiagramKind::kOther);
}

TEST(GraspDiagramTest, TheLinesOfForceOfAParallelGraspSeparateTheOuterContacts) {
  const grasp::Grasp grasp = OnSquare({{0, 0.9}, {2, 0.25}, {2, 0.75}});
  const GraspDiagram diagram = DescribeGrasp(MakeSquare(), grasp, Radians(20));
  ASSERT_EQ(diagram.kind, DiagramKind::kParallel);
  const Vector2d d = *diagram.force_direction;
  EXPECT_LT(AngleBetween2d(d, Vector2d(0, d.y())), Radians(20));
  const auto side = [&](int k) {
    const Vector2d reach = (grasp[k].p - grasp[0].p).head<2>();
    return d.x() * reach.y() - d.y() * reach.x();
  };
  EXPECT_LT(side(1) * side(2), 0);
}

TEST(GraspDiagramTest, OuterContactsOnOneSideOfTheCommonConeAreNotParallel) {
  const GraspDiagram diagram =
      DescribeGrasp(MakeSquare(), OnSquare({{0, 0.95}, {2, 0.8}, {2, 0.95}}), Radians(5));
  EXPECT_EQ(diagram.kind, DiagramKind::kOther);
  EXPECT_FALSE(diagram.force_direction);
}

TEST(GraspDiagramTest, TwoContactsAreATwoFingerGraspIfTheirLineIsInBothCones) {
  // Over a height of 2, the limit of the offset is 2 · tan 20° = 0.73.
  const auto kind = [](double shift) {
    return DescribeGrasp(MakeSquare(), OnSquare({{0, 0.5}, {2, 0.5 + shift / 2}}), Radians(20))
        .kind;
  };
  EXPECT_EQ(kind(0), DiagramKind::kTwoFinger);
  EXPECT_EQ(kind(0.72), DiagramKind::kTwoFinger);
  EXPECT_EQ(kind(0.74), DiagramKind::kOther);
}

TEST(GraspDiagramTest, TwoFingersMayStretchAHole) {
  const object::Polygon frame = object::Polygon::FromRings(
      {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}, "frame");
  const grasp::Grasp grasp = {OnEdge(frame, 4, 0.5), OnEdge(frame, 6, 0.5)};
  ASSERT_NEAR((grasp[0].p - grasp[1].p).norm(), 2, kClose);
  EXPECT_EQ(DescribeGrasp(frame, grasp, Radians(10)).kind, DiagramKind::kTwoFinger);
  const grasp::Grasp corner = {OnEdge(frame, 4, 0.5), OnEdge(frame, 5, 0.5)};
  EXPECT_EQ(DescribeGrasp(frame, corner, Radians(10)).kind, DiagramKind::kOther);
}

TEST(GraspDiagramTest, FourContactsShowTheirFrictionCones) {
  const GraspDiagram diagram =
      DescribeGrasp(MakeSquare(), OnSquare({{0, 0.5}, {1, 0.5}, {2, 0.5}, {3, 0.5}}), Radians(15));
  EXPECT_EQ(diagram.kind, DiagramKind::kOther);
  ASSERT_EQ(diagram.cones.size(), 4U);
  for (const DoubleCone& cone : diagram.cones) EXPECT_EQ(cone.friction_angle, Radians(15));
}

TEST(GraspDiagramTest, TheOrderOfContactsChangesNothingButTheOrderOfCones) {
  grasp::Grasp grasp = OnSquare({{0, 0.45}, {2, 0.25}, {2, 0.75}});
  const GraspDiagram first = DescribeGrasp(MakeSquare(), grasp, Radians(20));
  int checked = 0;
  for (int turn = 0; turn < 2; ++turn) {
    std::rotate(grasp.begin(), grasp.begin() + 1, grasp.end());
    const GraspDiagram turned = DescribeGrasp(MakeSquare(), grasp, Radians(20));
    EXPECT_EQ(turned.kind, first.kind);
    ASSERT_TRUE(turned.force_direction);
    EXPECT_LT((*turned.force_direction - *first.force_direction).norm(), kClose);
    ++checked;
  }
  EXPECT_EQ(checked, 2);
}

TEST(GraspDiagramTest, RandomGraspsOfAKindAreForceClosure) {
  // Independent check: a grasp drawn as one of the three types is force closure. Other grasps can
  // be either.
  const object::Polygon polygon = object::Polygon::FromRings(
      {{{0, 0}, {5, -1}, {6, 1}, {9, 0.5}, {10, 4}, {7, 4.5}, {8, 7}, {4, 8}, {3, 5}, {0, 6}}},
      "blob");
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0.01, 0.99);
  std::uniform_int_distribution<int> edge(0, polygon.face_count() - 1);
  const double theta = Radians(18);
  int counts[4] = {};
  for (int trial = 0; trial < 3000; ++trial) {
    grasp::Grasp grasp;
    const int fingers = 2 + trial % 2;
    for (int k = 0; k < fingers; ++k) {
      grasp.push_back(OnEdge(polygon, edge(random), place(random)));
    }
    const GraspDiagram diagram = DescribeGrasp(polygon, grasp, theta);
    ++counts[static_cast<int>(diagram.kind)];
    if (diagram.kind == DiagramKind::kOther) continue;
    EXPECT_TRUE(grasp::IsForceClosure(grasp, polygon.wrench_frame(), theta)) << trial;
  }
  for (const int count : counts) EXPECT_GT(count, 0);
}

TEST(GraspDiagramTest, RefusesContactsWithoutAFaceAndAnglesThatAreNone) {
  grasp::Grasp grasp = MiddleOfTriangle();
  EXPECT_THROW((void)DescribeGrasp(MakeTriangle(), grasp, 0), std::invalid_argument);
  EXPECT_THROW((void)DescribeGrasp(MakeTriangle(), grasp, Radians(90)), std::invalid_argument);
  EXPECT_THROW((void)DescribeGrasp(MakeTriangle(), grasp, std::nan("")), std::invalid_argument);
  grasp[1].face = {};
  EXPECT_THROW((void)DescribeGrasp(MakeTriangle(), grasp, Radians(20)), std::invalid_argument);
}

}  // namespace grasp_diagram_test
}  // namespace regrasp::render
