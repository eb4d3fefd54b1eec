#include "planner/roadmap/grasp_oracle.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "planner/base/angle.h"
#include "planner/grasp/force_closure.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp {
namespace {

constexpr double kNear = 1e-7;

struct Body {
  Polyhedron solid = MakeConvexBody(11, 2);
  std::vector<Contact> contacts = Centroids(solid);
  WrenchFrame frame = solid.wrench_frame();
  GraspOracle Oracle(std::function<bool(const Grasp&)> is_good = {}) const {
    return {contacts, frame, Radians(20), kNear, std::move(is_good)};
  }
};

std::vector<Quadruple> AllQuadruples(int count) {
  std::vector<Quadruple> all;
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      for (int c = b + 1; c < count; ++c) {
        for (int d = c + 1; d < count; ++d) all.push_back({a, b, c, d});
      }
    }
  }
  return all;
}

TEST(GraspKey, TellsGraspsApart) {
  std::set<std::uint64_t> keys;
  for (const Quadruple& grasp : AllQuadruples(18)) keys.insert(GraspKey(grasp));
  EXPECT_EQ(keys.size(), 3060u);
  constexpr int kLast = kMostOracleContacts - 1;
  EXPECT_NE(GraspKey({0, 1, 2, kLast}), GraspKey({0, 1, 3, kLast}));
  EXPECT_EQ(GraspKey({kLast - 3, kLast - 2, kLast - 1, kLast}), 0xfffcfffdfffeffffu);
}

TEST(GraspOracle, AdmitsForceClosureGraspsAndTestsEachOnce) {
  const Body body;
  GraspOracle oracle = body.Oracle();
  int admitted = 0;
  const std::vector<Quadruple> all = AllQuadruples(18);
  for (int round = 0; round < 2; ++round) {
    for (const Quadruple& grasp : all) {
      const bool expected = IsForceClosure(oracle.GraspOf(grasp), body.frame, Radians(20));
      EXPECT_EQ(oracle.Admits(grasp), expected);
      if (expected) ++admitted;
    }
    EXPECT_EQ(oracle.test_count(), std::ssize(all));
  }
  EXPECT_GT(admitted, 50);
  EXPECT_LT(admitted, std::ssize(all));
  EXPECT_EQ(oracle.good_count(), 0);
}

TEST(GraspOracle, AsksOfForceClosureGraspsOnlyWhetherTheyAreGood) {
  const Body body;
  GraspOracle plain = body.Oracle();
  const auto low = [](const Grasp& grasp) { return grasp[0].p.z() < 0; };
  GraspOracle picky = body.Oracle(low);
  int force_closure = 0;
  int refused = 0;
  for (const Quadruple& grasp : AllQuadruples(18)) {
    if (plain.Admits(grasp)) ++force_closure;
    EXPECT_EQ(picky.Admits(grasp), plain.Admits(grasp) && low(plain.GraspOf(grasp)));
    if (plain.Admits(grasp) && !picky.Admits(grasp)) ++refused;
  }
  EXPECT_EQ(picky.good_count(), force_closure);
  EXPECT_GT(refused, 10);
  EXPECT_LT(refused, force_closure);
}

TEST(GraspOracle, AdmitsNoGraspWithTwoContactsAtOnePoint) {
  Body body;
  GraspOracle plain = body.Oracle();
  // A twin of contact 0, a hair off and leaning.
  Contact twin = body.contacts[0];
  twin.n = (twin.n + 0.1 * twin.n.unitOrthogonal()).normalized();
  twin.p += 0.5 * kNear * twin.n.unitOrthogonal();
  body.contacts.push_back(twin);
  GraspOracle oracle = body.Oracle();
  const Contact away = {twin.p + 3 * kNear * twin.n.unitOrthogonal(), twin.n, twin.face};
  std::vector<Contact> apart = body.contacts;
  apart.back() = away;
  GraspOracle with_room(apart, body.frame, Radians(20), kNear);
  int refused = 0;
  for (int b = 1; b < 18; ++b) {
    for (int c = b + 1; c < 18; ++c) {
      const Quadruple both = {0, b, c, 18};
      EXPECT_FALSE(oracle.Admits(both));
      if (with_room.Admits(both)) ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(GraspOracle, RefusesMoreContactsThanItsKeysHold) {
  const std::vector<Contact> many(kMostOracleContacts + 1);
  EXPECT_THROW(GraspOracle(many, {}, Radians(20), kNear), std::invalid_argument);
}

}  // namespace
}  // namespace regrasp
