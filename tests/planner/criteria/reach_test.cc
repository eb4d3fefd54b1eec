#include "planner/criteria/reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "planner/object/polygon.h"
#include "tests/fixtures/solids.h"

namespace regrasp::criteria {
namespace reach_test {

using Eigen::Vector3d;

/// Return the contact at `p` on the face whose inward normal is `n`.
grasp::Contact At(const object::Object& object, const Vector3d& p, const Vector3d& n) {
  for (const FaceIndex face : object.FacesNear(p, object::kPointTolerance * object.diameter())) {
    if ((object.inward_normal(face) - n).norm() < 1e-9) return {p, n, face};
  }
  ADD_FAILURE() << "no face with normal " << n.transpose() << " at " << p.transpose();
  return {p, n, {}};
}

TEST(Reach, EndsAtAnInnerCornerWhereTheBallTouchesTheOtherWall) {
  const object::Polyhedron l = MakeLBlock();
  const auto near_corner = [&](double distance) {
    return At(l, {1 + distance, 1, 0.5}, {0, -1, 0});
  };
  EXPECT_FALSE(CanReach(l, near_corner(0.299), 0.3));
  EXPECT_TRUE(CanReach(l, near_corner(0.3), 0.3)) << "touching is allowed";
  EXPECT_TRUE(CanReach(l, near_corner(0.301), 0.3));
  EXPECT_FALSE(CanReach(l, near_corner(0), 1e-4));
  EXPECT_TRUE(CanReach(l, near_corner(0), 0)) << "a point reaches everything";
}

TEST(Reach, IsFreeAtConvexEdgesAndOnConvexBodies) {
  const object::Polyhedron cube = MakeCube();
  for (const double x : {0.0, 0.5, 0.999, 1.0}) {
    for (const double radius : {1e-9, 0.1, 1.0, 10.0}) {
      EXPECT_TRUE(CanReach(cube, At(cube, {x, 0.3, 1}, {0, 0, -1}), radius)) << x << " " << radius;
    }
  }
}

TEST(Reach, IsBlockedByTheOppositeWallOfAHole) {
  const object::Polyhedron ring = MakeRing();
  const grasp::Contact inside = At(ring, {1, 0, 0.5}, {1, 0, 0});
  for (const double radius : {1e-6, 0.1, 0.9, 1.1}) EXPECT_FALSE(CanReach(ring, inside, radius));
  const grasp::Contact outside = At(ring, {3, 0, 0.5}, {-1, 0, 0});
  EXPECT_TRUE(CanReach(ring, outside, 1.1));
}

TEST(Reach, SaysWhatFitsOrHowFarTheWayIsFree) {
  const object::Polyhedron ring = MakeRing();
  const grasp::Contact inside = At(ring, {1, 0, 0.5}, {1, 0, 0});
  EXPECT_FALSE(FindObstacle(ring, At(ring, {3, 0, 0.5}, {-1, 0, 0}), 0.5).has_value());
  // Between walls at distance 2, a sphere of radius 0.1 can move 1.8.
  const std::string obstacle = FindObstacle(ring, inside, 0.1).value_or("");
  EXPECT_NE(obstacle.find("1.8 of free path"), std::string::npos) << obstacle;
  const std::string ball = FindObstacle(ring, inside, 1.25).value_or("");
  EXPECT_NE(ball.find("a sphere of radius 1.25 at its contact penetrates the object, limit 1"),
            std::string::npos)
      << ball;
}

TEST(Reach, HoldsInThePlaneForDiscs) {
  const object::Polygon l =
      object::Polygon::FromRings({{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}}, "l");
  EXPECT_FALSE(CanReach(l, At(l, {1.29, 1, 0}, {0, -1, 0}), 0.3));
  EXPECT_TRUE(CanReach(l, At(l, {1.31, 1, 0}, {0, -1, 0}), 0.3));
  const object::Polygon frame = object::Polygon::FromRings(
      {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}}, "frame");
  EXPECT_FALSE(CanReach(frame, At(frame, {2, 1, 0}, {0, -1, 0}), 0.01));
  EXPECT_TRUE(CanReach(frame, At(frame, {2, 0, 0}, {0, 1, 0}), 0.01));
}

TEST(Reach, FingersKeepTheirDiameterApart) {
  const object::Polyhedron cube = MakeCube();
  const grasp::Contact a = At(cube, {0, 0, 1}, {0, 0, -1});
  const grasp::Contact b = At(cube, {0.4, 0, 1}, {0, 0, -1});
  EXPECT_TRUE(KeepApart(grasp::Grasp{a, b}, 0));
  EXPECT_TRUE(KeepApart(grasp::Grasp{a, b}, 0.2)) << "touching is allowed";
  EXPECT_FALSE(KeepApart(grasp::Grasp{a, b}, 0.201));
  EXPECT_FALSE(KeepApart(grasp::Grasp{b, a}, 0.201));
  EXPECT_TRUE(KeepApart(grasp::Grasp{a}, 100));
  EXPECT_TRUE(KeepApart(grasp::Grasp{a, b}, 0.199));
}

TEST(Reach, FingersOnTheTwoSidesOfAThinWallDoNotMeet) {
  const object::Polygon wall =
      object::Polygon::FromRings({{{0, 0}, {4, 0}, {4, 0.01}, {0, 0.01}}}, "wall");
  const grasp::Grasp pinch = {At(wall, {2, 0, 0}, {0, 1, 0}), At(wall, {2, 0.01, 0}, {0, -1, 0})};
  EXPECT_TRUE(KeepApart(pinch, 0.5));
}

TEST(Reach, NoFingerComesIntoASealedCavityHoweverThin) {
  const object::Polyhedron hollow = MakeHollowCube();
  const grasp::Contact inside = At(hollow, {0.5, 0, 0}, {1, 0, 0});
  const grasp::Contact outside = At(hollow, {1, 0, 0}, {-1, 0, 0});
  for (const double radius : {0.0, 1e-9, 0.1}) {
    EXPECT_FALSE(CanReach(hollow, inside, radius));
    EXPECT_EQ(FindObstacle(hollow, inside, radius).value_or(""),
              "its contact is in a sealed cavity");
    EXPECT_TRUE(CanReach(hollow, outside, radius));
  }
  // A hole of a polygon is a hole through a prism, which a finger can enter from above.
  const object::Polygon frame = object::Polygon::FromRings(
      {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}}, "frame");
  EXPECT_TRUE(CanReach(frame, At(frame, {2, 1, 0}, {0, -1, 0}), 0));
}

/// Return the least distance of sampled points from the axis of the finger's swept volume.
/// The points are on all faces but the contact's own.
double SampledClearance(const object::Polyhedron& body, const grasp::Contact& contact,
                        double radius, std::mt19937_64& random) {
  constexpr int kSamples = 4000;
  std::uniform_real_distribution<double> uniform(0, 1);
  const Vector3d rest = BallCentre(contact, radius);
  double least = std::numeric_limits<double>::infinity();
  for (object::TriangleIndex t{0}; t < std::ssize(body.triangles()); ++t) {
    if (body.face_of_triangle(t) == contact.face) continue;
    const auto& [i, j, k] = body.triangles()[t];
    for (int s = 0; s < kSamples; ++s) {
      double u = uniform(random), v = uniform(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vector3d q = body.vertices()[i] + u * (body.vertices()[j] - body.vertices()[i]) +
                         v * (body.vertices()[k] - body.vertices()[i]);
      const double along = std::clamp(-contact.n.dot(q - rest), 0.0, body.diameter());
      least = std::min(least, (q - rest + along * contact.n).norm());
    }
  }
  return least;
}

TEST(Reach, AgreesWithSampledPointsOfTheSurface) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  int free = 0, blocked = 0;
  for (const object::Polyhedron& body : {MakeLBlock(), MakeRing()}) {
    for (int draw = 0; draw < 150; ++draw) {
      const object::TriangleIndex t(
          static_cast<int>(uniform(random) * std::ssize(body.triangles())));
      const auto& [i, j, k] = body.triangles()[t];
      double u = uniform(random), v = uniform(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const FaceIndex face = body.face_of_triangle(t);
      const grasp::Contact contact = {body.vertices()[i] +
                                          u * (body.vertices()[j] - body.vertices()[i]) +
                                          v * (body.vertices()[k] - body.vertices()[i]),
                                      body.inward_normal(face), face};
      const double radius = 0.02 + 0.5 * uniform(random);
      // A sampled point inside the capsule proves that the contact is out of reach. If even a
      // capsule enlarged by the samples' spacing contains no point, the contact is reachable.
      constexpr double kSpacing = 0.15;
      const double clearance = SampledClearance(body, contact, radius, random);
      if (clearance < radius * (1 - 1e-9)) {
        EXPECT_FALSE(CanReach(body, contact, radius)) << contact.p.transpose();
        ++blocked;
      } else if (clearance > radius + kSpacing) {
        EXPECT_TRUE(CanReach(body, contact, radius)) << contact.p.transpose();
        ++free;
      }
    }
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(blocked, 20);
}

TEST(Reach, AThickerFingerReachesNoMoreAndTheUnitOfLengthDoesNotMatter) {
  int changes = 0;
  for (const double size : {1e-3, 1.0, 1e3}) {
    const object::Polygon l = object::Polygon::FromRings(
        {{{0, 0}, {3 * size, 0}, {3 * size, size}, {size, size}, {size, 3 * size}, {0, 3 * size}}},
        "l");
    const grasp::Contact contact = At(l, {1.5 * size, size, 0}, {0, -1, 0});
    bool before = true;
    for (int step = 1; step <= 20; ++step) {
      const bool now = CanReach(l, contact, step * 0.049 * size);
      EXPECT_TRUE(before || !now);
      EXPECT_EQ(now, step * 0.049 <= 0.5);
      changes += now != before;
      before = now;
    }
  }
  EXPECT_EQ(changes, 3);
}

}  // namespace reach_test
}  // namespace regrasp::criteria
