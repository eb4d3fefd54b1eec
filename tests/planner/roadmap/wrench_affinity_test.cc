#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/base/number.h"
#include "planner/roadmap/contact_clusters.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp::roadmap {
namespace wrench_affinity_test {

/// Accuracy of angles according to the header.
constexpr double kAngle = 7e-5;

const double kFrictionAngle = Radians(10);

/// Return the distance as defined in the dissertation: arccosines of the standard library, for
/// every shift.
double DistanceByShifts(const WrenchPyramid& a, const WrenchPyramid& b) {
  double least = std::numeric_limits<double>::infinity();
  for (int shift = 0; shift < kPyramidSides; ++shift) {
    double sum = 0;
    for (int k = 0; k < kPyramidSides; ++k) {
      const auto other = (k + shift) % kPyramidSides;
      sum += std::acos(std::clamp(a.col(k).dot(b.col(other)), -1.0, 1.0));
    }
    least = std::min(least, sum / kPyramidSides);
  }
  return least;
}

std::vector<WrenchPyramid> PyramidsOf(const object::Polyhedron& solid) {
  const std::vector<grasp::Contact> contacts = Centroids(solid);
  std::vector<WrenchPyramid> pyramids;
  for (const grasp::Contact& contact : contacts) {
    pyramids.push_back(PyramidOf(contact, solid.wrench_frame(), kFrictionAngle, contacts));
  }
  return pyramids;
}

TEST(PyramidOf, HasUnitWrenchesOfForcesOnTheCone) {
  const object::WrenchFrame frame{{0.01, 0, 0}, 0.05, 3};
  const grasp::Contact contact{{0.03, 0.02, 0.01}, Eigen::Vector3d(-1, 0.2, 0.1).normalized(), {}};
  const WrenchPyramid pyramid = PyramidOf(contact, frame, kFrictionAngle, Eigen::Vector3d::UnitY());
  const Eigen::Vector3d arm = (contact.p - frame.origin) / frame.radius;
  for (int side = 0; side < kPyramidSides; ++side) {
    EXPECT_NEAR(pyramid.col(side).norm(), 1, 1e-14);
    const Eigen::Vector3d force = pyramid.col(side).head<3>();
    EXPECT_NEAR(std::acos(force.normalized().dot(contact.n)), kFrictionAngle, 1e-12);
    EXPECT_NEAR((arm.cross(force) - pyramid.col(side).tail<3>()).norm(), 0, 1e-14);
    const Eigen::Vector3d next = pyramid.col((side + 1) % kPyramidSides).head<3>();
    EXPECT_GT(force.cross(next).dot(contact.n), 0) << "counter-clockwise about the normal";
  }
  const Eigen::Vector3d first = pyramid.col(0).head<3>();
  const Eigen::Vector3d along = first - first.dot(contact.n) * contact.n;
  EXPECT_NEAR(along.normalized().dot(contact.n.cross(Eigen::Vector3d::UnitY())), 0, 1e-12);
  EXPECT_GT(along.y(), 0);
}

TEST(PyramidOf, TakesTheOthersWhereTheContactIsStraightAboveTheOrigin) {
  const object::WrenchFrame frame{Eigen::Vector3d::Zero(), 0.05, 3};
  const grasp::Contact above{{0, 0, 0.05}, -Eigen::Vector3d::UnitZ(), {}};
  const grasp::Contact aside{{0.02, 0, 0.03}, -Eigen::Vector3d::UnitZ(), {}};
  const std::vector<grasp::Contact> others = {above, aside};
  const WrenchPyramid pyramid = PyramidOf(above, frame, kFrictionAngle, others);
  EXPECT_TRUE(pyramid.isApprox(PyramidOf(above, frame, kFrictionAngle, Eigen::Vector3d::UnitX())));
  const WrenchPyramid alone = PyramidOf(above, frame, kFrictionAngle, std::span(others).first(1));
  EXPECT_TRUE(alone.allFinite());
}

TEST(WrenchDistance, IsThatOfAllShiftsWithTheLibrarysArccosine) {
  const std::vector<WrenchPyramid> pyramids = PyramidsOf(MakeConvexBody(20, 1));
  int shifted = 0;
  for (const WrenchPyramid& a : pyramids) {
    for (const WrenchPyramid& b : pyramids) {
      EXPECT_NEAR(WrenchDistance(a, b), DistanceByShifts(a, b), kAngle);
      double unshifted = 0;
      for (int k = 0; k < kPyramidSides; ++k) unshifted += std::acos(a.col(k).dot(b.col(k)));
      if (unshifted / kPyramidSides > WrenchDistance(a, b) + 0.01) ++shifted;
    }
  }
  EXPECT_GT(shifted, 50);
}

TEST(WrenchDistance, OfForcesAtTheOriginIsTheAngleBetweenTheNormalsAtLeast) {
  // At the origin there is no torque, and both pyramids start along the rotation axis. Each force
  // rotates by the angle times the sine of its angle to that axis.
  const object::WrenchFrame frame{Eigen::Vector3d::Zero(), 1, 3};
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  for (const double turn : {0.0, 0.05, 0.3, 1.0}) {
    const grasp::Contact a{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), {}};
    const grasp::Contact b{Eigen::Vector3d::Zero(), Eigen::AngleAxisd(turn, axis) * a.n, {}};
    double expected = 0;
    for (int k = 0; k < kPyramidSides; ++k) {
      const double along_axis =
          std::sin(kFrictionAngle) * std::cos(2 * std::numbers::pi * k / kPyramidSides);
      const double chord = 2 * std::sqrt(1 - along_axis * along_axis) * std::sin(turn / 2);
      expected += 2 * std::asin(chord / 2) / kPyramidSides;
    }
    EXPECT_NEAR(WrenchDistance(PyramidOf(a, frame, kFrictionAngle, axis),
                               PyramidOf(b, frame, kFrictionAngle, axis)),
                expected, kAngle);
  }
}

TEST(WrenchDistance, OfAPyramidTurnedByWholeSidesIsZero) {
  const object::WrenchFrame frame{Eigen::Vector3d::Zero(), 0.05, 3};
  const grasp::Contact contact{{0.03, 0.02, 0.01}, Eigen::Vector3d(-1, 0.2, 0.1).normalized(), {}};
  const Eigen::Vector3d towards = contact.n.unitOrthogonal();
  const WrenchPyramid pyramid = PyramidOf(contact, frame, kFrictionAngle, towards);
  const auto turned = [&](double sides) {
    const Eigen::AngleAxisd turn(2 * std::numbers::pi * sides / kPyramidSides, contact.n);
    return WrenchDistance(pyramid, PyramidOf(contact, frame, kFrictionAngle, turn * towards));
  };
  for (int sides = 0; sides < kPyramidSides; ++sides) EXPECT_NEAR(turned(sides), 0, 1e-7);
  EXPECT_GT(turned(0.5), 0.01);
}

TEST(WrenchDistance, IsSymmetricAndZeroToItselfOnly) {
  const std::vector<WrenchPyramid> pyramids = PyramidsOf(MakeConvexBody(20, 2));
  const Eigen::MatrixXd distances = WrenchDistances(pyramids);
  ASSERT_EQ(distances.rows(), 36);
  EXPECT_EQ(distances, distances.transpose());
  for (int i = 0; i < 36; ++i) {
    EXPECT_EQ(distances(i, i), 0);
    EXPECT_NEAR(WrenchDistance(pyramids[i], pyramids[i]), 0, 1e-7);
    for (int j = 0; j < 36; ++j) {
      if (i == j) continue;
      EXPECT_NEAR(WrenchDistance(pyramids[i], pyramids[j]), distances(i, j), 1e-14);
      EXPECT_GT(distances(i, j), 1e-3);
      EXPECT_LE(distances(i, j), std::numbers::pi);
    }
  }
}

TEST(WrenchDistance, DependsNeitherOnTheUnitOfLengthNorOnThePose) {
  const object::Polyhedron body = MakeConvexBody(20, 3);
  const Eigen::MatrixXd distances = WrenchDistances(PyramidsOf(body));
  for (const double unit : {1.0, 1000.0, 0.003}) {
    const object::Polyhedron moved = Moved(body, MotionAndUnit(unit));
    EXPECT_TRUE(WrenchDistances(PyramidsOf(moved)).isApprox(distances, 1e-7)) << unit;
  }
  // If torques were not divided by the radius, the unit would matter.
  object::WrenchFrame frame = body.wrench_frame();
  const std::vector<grasp::Contact> contacts = Centroids(body);
  const auto distance = [&] {
    return WrenchDistance(PyramidOf(contacts[0], frame, kFrictionAngle, contacts),
                          PyramidOf(contacts[1], frame, kFrictionAngle, contacts));
  };
  const double before = distance();
  frame.radius = 1;
  EXPECT_GT(std::abs(distance() - before), 1e-3);
}

}  // namespace wrench_affinity_test
}  // namespace regrasp::roadmap
