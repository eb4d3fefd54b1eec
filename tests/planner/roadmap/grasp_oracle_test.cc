#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/roadmap/grasp_tree.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp::roadmap {
namespace grasp_oracle_test {

struct Body {
  object::Polyhedron solid = MakeConvexBody(11, 2);
  double same_point = criteria::kSamePoint * solid.diameter();
  std::vector<grasp::Contact> contacts = Centroids(solid);
  object::WrenchFrame frame = solid.wrench_frame();
  [[nodiscard]] grasp::Grasp GraspOf(const Quadruple& numbers) const {
    grasp::Grasp grasp;
    for (const int number : numbers) grasp.push_back(contacts[number]);
    return grasp;
  }
  [[nodiscard]] GraspOracle Oracle(double min_quality = 0) const {
    return {solid, contacts, {Radians(20), min_quality}};
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
  constexpr int kLast = (1 << 16) - 1;
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
      const bool expected = grasp::IsForceClosure(body.GraspOf(grasp), body.frame, Radians(20));
      EXPECT_EQ(oracle.Admits(grasp), expected);
      if (expected) ++admitted;
    }
    EXPECT_EQ(oracle.counts().force_closure, std::ssize(all));
  }
  EXPECT_GT(admitted, 50);
  EXPECT_LT(admitted, std::ssize(all));
  EXPECT_EQ(oracle.counts().criteria, 0);
}

TEST(GraspOracle, AsksOfForceClosureGraspsOnlyWhetherTheyMeetTheCriteria) {
  constexpr double kQuality = 0.05;
  const Body body;
  GraspOracle plain = body.Oracle();
  GraspOracle picky = body.Oracle(kQuality);
  int force_closure = 0;
  int refused = 0;
  for (const Quadruple& grasp : AllQuadruples(18)) {
    const bool holds = plain.Admits(grasp);
    if (holds) ++force_closure;
    EXPECT_EQ(picky.Admits(grasp), holds && grasp::QualityAtLeast(body.GraspOf(grasp), body.frame,
                                                                  Radians(20), kQuality));
    if (holds && !picky.Admits(grasp)) ++refused;
  }
  EXPECT_EQ(picky.counts().criteria, force_closure);
  EXPECT_GT(refused, 10);
  EXPECT_LT(refused, force_closure);
}

TEST(GraspOracle, TestsNoGraspForForceClosureAgainWhenLessIsAskedFor) {
  const Body body;
  GraspOracle oracle = body.Oracle(0.05);
  GraspOracle plain = body.Oracle();
  const std::vector<Quadruple> all = AllQuadruples(18);
  for (const Quadruple& grasp : all) (void)oracle.Admits(grasp);
  oracle.SetShare(0);
  for (const Quadruple& grasp : all) EXPECT_EQ(oracle.Admits(grasp), plain.Admits(grasp));
  EXPECT_EQ(oracle.counts().force_closure, std::ssize(all));
}

TEST(GraspOracle, MakesAnEndWhenTheTimeIsUp) {
  const Body body;
  const Deadline over = std::chrono::steady_clock::now();
  GraspOracle oracle(body.solid, body.contacts, {Radians(20), 0}, {}, over);
  EXPECT_THROW((void)oracle.Admits({0, 1, 2, 3}), TimeUp);
}

TEST(GraspOracle, AdmitsNoGraspWithTwoContactsAtOnePoint) {
  Body body;
  GraspOracle plain = body.Oracle();
  // Duplicate of contact 0, slightly displaced and inclined.
  grasp::Contact twin = body.contacts[0];
  twin.n = (twin.n + 0.1 * twin.n.unitOrthogonal()).normalized();
  twin.p += 0.5 * body.same_point * twin.n.unitOrthogonal();
  body.contacts.push_back(twin);
  GraspOracle oracle = body.Oracle();
  const grasp::Contact away = {twin.p + 3 * body.same_point * twin.n.unitOrthogonal(), twin.n,
                               twin.face};
  std::vector<grasp::Contact> apart = body.contacts;
  apart.back() = away;
  GraspOracle farther(body.solid, apart, {Radians(20), 0});
  int refused = 0;
  for (int b = 1; b < 18; ++b) {
    for (int c = b + 1; c < 18; ++c) {
      const Quadruple both = {0, b, c, 18};
      EXPECT_FALSE(oracle.Admits(both));
      if (farther.Admits(both)) ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_FALSE(plain.Admits({0, 1, 1, 2}));
}

TEST(GraspOracle, RefusesMoreContactsThanSetsHaveNumbers) {
  const Body body;
  const std::vector<grasp::Contact> many(criteria::ContactSet::kMostNumbers + 1, body.contacts[0]);
  EXPECT_THROW(GraspOracle(body.solid, many, {Radians(20), 0}), std::invalid_argument);
}

}  // namespace grasp_oracle_test
}  // namespace regrasp::roadmap
