#include "planner/plan/contact_region.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::plan {
namespace contact_region_test {

/// Draw an uneven outline around a circle, with convex and concave corners.
Ring DrawRing(int edges, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Ring ring;
  for (int i = 0; i < edges; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.8 * unit(random)) / edges;
    const double radius = 1 + 0.04 * unit(random);
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return ring;
}

double Measure(const object::Polygon& polygon, const grasp::Grasp& grasp, double degrees) {
  return MeasureContactRegion(polygon, grasp, Radians(degrees), polygon.diameter());
}

/// Return the contact moved by `way` along the outer ring.
grasp::Contact Along(const object::Polygon& polygon, grasp::Contact contact, double way) {
  const int count = polygon.face_count();
  const auto [from, to] = polygon.edge(contact.face);
  double at = (contact.p - from).norm() + way;
  FaceIndex edge = contact.face;
  while (at < 0) {
    edge = FaceIndex((edge + count - 1) % count);
    at += polygon.face_measure(edge);
  }
  while (at > polygon.face_measure(edge)) {
    at -= polygon.face_measure(edge);
    edge = FaceIndex((edge + 1) % count);
  }
  return OnEdge(polygon, edge, at / polygon.face_measure(edge));
}

TEST(ContactRegion, OfOppositeContactsOnASquareIsGivenByTheConesOrTheCorners) {
  const object::Polygon square = MakeSquare();
  const double accuracy = kRegionAccuracy * square.diameter();
  int checked = 0;
  for (const double degrees : {1.0, 10.0, 20.0, 30.0, 40.0}) {
    for (const double height : {0.0, 0.3, 0.7, -0.95}) {
      const grasp::Grasp grasp = {OnEdge(square, 1, (1 + height) / 2),
                                  OnEdge(square, 3, (1 - height) / 2)};
      // Both contacts are displaced by h in opposite directions: the line between them rises by 2 h
      // over the width of 2.
      const double expected = std::min(std::tan(Radians(degrees)), 1 - std::abs(height));
      EXPECT_NEAR(Measure(square, grasp, degrees), expected, 2 * accuracy) << degrees;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 20);
}

TEST(ContactRegion, OfSkewContactsIsWhatTheConeHasLeft) {
  const object::Polygon square = MakeSquare();
  const grasp::Grasp grasp = {OnEdge(square, 1, 0.55), OnEdge(square, 3, 0.55)};
  EXPECT_NEAR(Measure(square, grasp, 20), std::tan(Radians(20)) - 0.1,
              2 * kRegionAccuracy * square.diameter());
}

TEST(ContactRegion, CrossesVerticesAndTheRingsFirstOne) {
  // A strip whose long sides are divided into uneven pieces with straight angles. The ring's first
  // vertex is inside the region of the lower contact.
  const object::Polygon strip = object::Polygon::FromRings(
      {{{0, 0}, {0.1, 0}, {0.13, 0}, {3, 0}, {3, 1}, {0.2, 1}, {-0.05, 1}, {-3, 1}, {-3, 0}}},
      "strip");
  const grasp::Grasp grasp = {OnEdge(strip, 0, 0.4), OnEdge(strip, 5, 0.64)};
  ASSERT_NEAR(grasp[0].p.x(), grasp[1].p.x(), 1e-12);
  EXPECT_NEAR(Measure(strip, grasp, 20), std::tan(Radians(20)) / 2,
              2 * kRegionAccuracy * strip.diameter());
}

TEST(ContactRegion, OfADiscIsAboutTheFrictionAngleTimesTheRadius) {
  constexpr int kEdges = 120;
  const object::Polygon disc = MakeDisc(kEdges, 2);
  for (const double degrees : {10.0, 15.0, 20.0}) {
    const grasp::Grasp grasp = {OnEdge(disc, 7, 0.5), OnEdge(disc, 7 + kEdges / 2, 0.5)};
    // Contacts displaced by h and −h tilt the line by h/r; normals are accurate to half an edge's
    // angle.
    const double slack = 2 * std::numbers::pi / kEdges * 2;
    EXPECT_NEAR(Measure(disc, grasp, degrees), 2 * Radians(degrees), slack);
  }
}

TEST(ContactRegion, OfAFingerInAHoleStretchesBetweenItsSides) {
  const object::Polygon frame = object::Polygon::FromRings(
      {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}, "frame");
  int left = -1, right = -1, outside = -1;
  for (FaceIndex edge{0}; edge < frame.face_count(); ++edge) {
    const Eigen::Vector3d middle = OnEdge(frame, edge, 0.5).p;
    if ((middle - Eigen::Vector3d(-1, 0, 0)).norm() < 1e-9) left = edge;
    if ((middle - Eigen::Vector3d(1, 0, 0)).norm() < 1e-9) right = edge;
    if ((middle - Eigen::Vector3d(4, 0, 0)).norm() < 1e-9) outside = edge;
  }
  ASSERT_TRUE(left >= 4 && right >= 4 && outside >= 0);
  const double accuracy = 2 * kRegionAccuracy * frame.diameter();
  const double slope = std::tan(Radians(15));
  EXPECT_NEAR(Measure(frame, {OnEdge(frame, left, 0.5), OnEdge(frame, right, 0.5)}, 15), slope,
              accuracy);
  EXPECT_NEAR(Measure(frame, {OnEdge(frame, right, 0.5), OnEdge(frame, outside, 0.5)}, 15),
              1.5 * slope, accuracy);
}

TEST(ContactRegion, IsZeroAtTheEndOfTheSetAndWithoutForceClosure) {
  const object::Polygon square = MakeSquare();
  EXPECT_EQ(Measure(square, {OnEdge(square, 1, 0.5), OnEdge(square, 3, 0.9)}, 20), 0);
  EXPECT_EQ(Measure(square, {OnEdge(square, 1, 0.5), OnEdge(square, 2, 0.5)}, 20), 0);
  // One contact is at a vertex, the end of its edge: beyond it the grasp is not force closure.
  EXPECT_LT(Measure(square, {OnEdge(square, 1, 1), OnEdge(square, 3, 0)}, 20), 1e-6);
}

TEST(ContactRegion, GivesNoMoreThanTheLimitAndRefusesWhatIsNoGrasp) {
  const object::Polygon square = MakeSquare();
  const grasp::Grasp grasp = {OnEdge(square, 1, 0.5), OnEdge(square, 3, 0.5)};
  EXPECT_EQ(MeasureContactRegion(square, grasp, Radians(20), 0.125), 0.125);
  EXPECT_EQ(MeasureContactRegion(square, grasp, Radians(20), 0), 0);
  const auto refuses = [&](const grasp::Grasp& bad, double limit) {
    EXPECT_THROW(static_cast<void>(MeasureContactRegion(square, bad, Radians(20), limit)),
                 std::invalid_argument);
  };
  refuses({grasp[0]}, 1);
  refuses({grasp[0], grasp[1], grasp[0]}, 1);
  refuses({grasp[0], {grasp[1].p, grasp[1].n, {}}}, 1);
  refuses({grasp[0], {grasp[1].p, grasp[1].n, FaceIndex(4)}}, 1);
  refuses(grasp, -1);
  refuses(grasp, std::numeric_limits<double>::infinity());
}

/// Random force-closure grasp on a random outline.
struct RandomCase {
  object::Polygon polygon;
  grasp::Grasp grasp;
  double degrees;
};

std::vector<RandomCase> DrawCases() {
  std::mt19937 random(11);
  std::vector<RandomCase> cases;
  for (const int edges : {7, 15, 40, 90}) {
    for (const double degrees : {10.0, 20.0, 35.0}) {
      const object::Polygon polygon =
          object::Polygon::FromRings({DrawRing(edges, random)}, "outline");
      std::uniform_int_distribution<int> edge(0, edges - 1);
      std::uniform_real_distribution<double> share(0, 1);
      int found = 0;
      while (found < 5) {
        const grasp::Grasp grasp = {OnEdge(polygon, edge(random), share(random)),
                                    OnEdge(polygon, edge(random), share(random))};
        if (!grasp::IsForceClosure(grasp, polygon.wrench_frame(), Radians(degrees))) continue;
        cases.push_back({polygon, grasp, degrees});
        ++found;
      }
    }
  }
  return cases;
}

TEST(ContactRegion, HoldsEveryGraspInsideAndNotAllALittleOutside) {
  constexpr int kGrid = 100;
  long inside = 0;
  int ended = 0, checked = 0;
  for (const RandomCase& one : DrawCases()) {
    const double h = Measure(one.polygon, one.grasp, one.degrees);
    const object::WrenchFrame frame = one.polygon.wrench_frame();
    const auto holds = [&](double a, double b) {
      return grasp::IsForceClosure(
          grasp::Grasp{Along(one.polygon, one.grasp[0], a), Along(one.polygon, one.grasp[1], b)},
          frame, Radians(one.degrees));
    };
    for (int i = 0; i <= kGrid; ++i) {
      for (int j = 0; j <= kGrid; ++j) {
        ASSERT_TRUE(holds(h * (2.0 * i / kGrid - 1), h * (2.0 * j / kGrid - 1)));
        ++inside;
      }
    }
    // Negative control: on the boundary of a slightly larger square at least one grasp is not force
    // closure.
    const double beyond = h + 2e-3;
    bool all = true;
    for (int i = 0; i <= 20 * kGrid && all; ++i) {
      const double at = beyond * (2.0 * i / (20 * kGrid) - 1);
      all = holds(at, beyond) && holds(at, -beyond) && holds(beyond, at) && holds(-beyond, at);
    }
    ended += !all;
    ++checked;
  }
  std::cout << inside << " grasps inside hold, " << ended << " of " << checked
            << " regions end there\n";
  EXPECT_EQ(checked, 60);
  EXPECT_EQ(ended, checked);
}

TEST(ContactRegion, IsTheSameUnderRigidMotionScaleAndOrderAndGrowsWithFriction) {
  const double angle = 0.7, scale = 37;
  const Eigen::Rotation2D<double> turn(angle);
  int checked = 0, grew = 0;
  for (const RandomCase& one : DrawCases()) {
    const double h = Measure(one.polygon, one.grasp, one.degrees);
    Ring moved;
    for (const Eigen::Vector2d& p : one.polygon.rings().front()) {
      moved.emplace_back(scale * (turn * p) + Eigen::Vector2d(5, -8));
    }
    const object::Polygon other = object::Polygon::FromRings({moved}, "moved");
    grasp::Grasp grasp;
    for (const grasp::Contact& contact : one.grasp) {
      const auto [from, to] = one.polygon.edge(contact.face);
      grasp.push_back(OnEdge(other, contact.face, (contact.p - from).norm() / (to - from).norm()));
    }
    const double accuracy = 3 * kRegionAccuracy * other.diameter();
    EXPECT_NEAR(Measure(other, grasp, one.degrees), scale * h, accuracy);
    EXPECT_NEAR(Measure(one.polygon, {one.grasp[1], one.grasp[0]}, one.degrees), h, accuracy);
    const double more = Measure(one.polygon, one.grasp, one.degrees + 3);
    EXPECT_GE(more, h - accuracy / scale);
    grew += more > h + 1e-3;
    ++checked;
  }
  EXPECT_EQ(checked, 60);
  EXPECT_GT(grew, 0);
}

TEST(SwitchRegion, IsTheSmallerOneOfBothGraspsAndHoldsTheClaimAgainstIt) {
  const object::Polygon square = MakeSquare();
  const FingerGrasp before = {{FingerIndex(0), OnEdge(square, 1, 0.5)},
                              {FingerIndex(1), OnEdge(square, 3, 0.5)}};
  Switch step{{{FingerIndex(2), OnEdge(square, 3, 0.55)}}, {FingerIndex(1)}};
  const double expected = std::tan(Radians(20)) - 0.05;
  const auto measure = [&] { return MeasureSwitchRegion(square, before, step, Radians(20)); };
  ASSERT_TRUE(measure().has_value());
  EXPECT_NEAR(measure()->half_width, expected, 1e-6);
  EXPECT_FALSE(measure()->claimed.has_value());
  EXPECT_TRUE(measure()->holds);
  step.place[0].region = expected - 1e-6;
  EXPECT_EQ(measure()->claimed, expected - 1e-6);
  EXPECT_TRUE(measure()->holds);
  step.place[0].region = expected + 1e-4;
  EXPECT_FALSE(measure()->holds);
}

TEST(SwitchRegion, IsOnlyOfSwitchesBetweenGraspsOfTwoContacts) {
  const object::Polygon square = MakeSquare();
  const FingerGrasp before = {{FingerIndex(0), OnEdge(square, 1, 0.5)},
                              {FingerIndex(1), OnEdge(square, 3, 0.5)}};
  const Switch step{{{FingerIndex(2), OnEdge(square, 0, 0.5)}}, {}};
  EXPECT_FALSE(MeasureSwitchRegion(square, before, step, Radians(20)).has_value());
}

}  // namespace contact_region_test
}  // namespace regrasp::plan
