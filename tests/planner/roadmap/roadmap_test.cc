#include "planner/roadmap/roadmap.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure.h"
#include "planner/sampling/contact_points.h"
#include "planner/search/switching_graph.h"
#include "tests/fixtures/solids.h"

namespace regrasp::roadmap {
namespace roadmap_test {

constexpr double kSamePoint = 1e-7;

Roadmap MakeRoadmap(const std::vector<grasp::Contact>& points, double degrees) {
  return Roadmap(points, MakeBox({0.06, 0.06, 0.06}).wrench_frame(), Radians(degrees), kSamePoint);
}

std::vector<grasp::Contact> CubePoints(int count, std::uint64_t seed = 1) {
  return sampling::SpreadContactPoints(MakeBox({0.06, 0.06, 0.06}), count, seed);
}

TEST(Roadmap, HasOneVertexPerForceClosureGraspOfFour) {
  const std::vector<grasp::Contact> points = CubePoints(14);
  const Roadmap roadmap = MakeRoadmap(points, 20);
  int force_closure = 0;
  int others = 0;
  for (int a = 0; a < 14; ++a) {
    for (int b = a + 1; b < 14; ++b) {
      for (int c = b + 1; c < 14; ++c) {
        for (int d = c + 1; d < 14; ++d) {
          const grasp::Grasp grasp = {points[a], points[b], points[c], points[d]};
          const bool expected =
              grasp::IsForceClosure(grasp, MakeBox({0.06, 0.06, 0.06}).wrench_frame(), Radians(20));
          EXPECT_EQ(roadmap.Find(std::array{d, b, a, c}).has_value(), expected);
          ++(expected ? force_closure : others);
        }
      }
    }
  }
  EXPECT_EQ(roadmap.vertex_count(), force_closure);
  EXPECT_EQ(roadmap.candidate_count(), force_closure + others);
  EXPECT_GT(force_closure, 20);
  EXPECT_GT(others, 20);
}

TEST(Roadmap, JoinsGraspsThatShareThreeContacts) {
  const Roadmap roadmap = MakeRoadmap(CubePoints(16), 20);
  std::vector<int> neighbours;
  std::int64_t edges = 0;
  for (int v = 0; v < roadmap.vertex_count(); ++v) {
    roadmap.GetNeighbours(v, neighbours);
    std::sort(neighbours.begin(), neighbours.end());
    std::vector<int> expected;
    for (int other = 0; other < roadmap.vertex_count(); ++other) {
      if (roadmap.MinSwitches(v, other) == 1) expected.push_back(other);
    }
    ASSERT_EQ(neighbours, expected);
    edges += std::ssize(expected);
  }
  EXPECT_GT(edges, 100);
  EXPECT_EQ(roadmap.CountEdges(), edges / 2);
}

TEST(Roadmap, ComponentsAreWhatASequenceCanReach) {
  int split = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Roadmap roadmap = MakeRoadmap(CubePoints(9, seed), 12);
    const search::Components components = roadmap.FindComponents();
    for (int v = 0; v < roadmap.vertex_count(); ++v) {
      const auto reached = search::ReachableVertices(roadmap, v, [](int) { return true; });
      EXPECT_EQ(components.sizes[components.of_vertex[v]], std::ssize(reached));
    }
    if (components.count() > 1) ++split;
  }
  EXPECT_GT(split, 0);
}

TEST(Roadmap, CountsContactsThatAreNotShared) {
  const Roadmap roadmap = MakeRoadmap(CubePoints(12), 30);
  ASSERT_GT(roadmap.vertex_count(), 1);
  for (int v = 0; v < roadmap.vertex_count(); ++v) {
    EXPECT_EQ(roadmap.MinSwitches(v, v), 0);
    EXPECT_EQ(roadmap.MinSwitches(0, v), roadmap.MinSwitches(v, 0));
  }
}

TEST(Roadmap, NeverHasTwoFingersAtOnePoint) {
  std::vector<grasp::Contact> points = CubePoints(12);
  const Roadmap plain = MakeRoadmap(points, 30);
  // The same point with a slightly inclined normal, as on the border of two faces.
  grasp::Contact twin = points[0];
  twin.n = (twin.n + 0.2 * points[0].p.unitOrthogonal().cross(twin.n)).normalized();
  points.push_back(twin);
  const Roadmap roadmap = MakeRoadmap(points, 30);
  int with_twin = 0;
  std::int64_t edges = 0;
  std::vector<int> neighbours;
  for (int v = 0; v < roadmap.vertex_count(); ++v) {
    const Quadruple& vertex = roadmap.vertex(v);
    const bool has_point = vertex[0] == 0;
    const bool has_twin = vertex[3] == 12;
    EXPECT_FALSE(has_point && has_twin);
    with_twin += has_twin ? 1 : 0;
    roadmap.GetNeighbours(v, neighbours);
    edges += std::ssize(neighbours);
    for (const int other : neighbours) {
      EXPECT_FALSE(has_point && roadmap.vertex(other)[3] == 12);
      EXPECT_FALSE(has_twin && roadmap.vertex(other)[0] == 0);
    }
  }
  EXPECT_GT(with_twin, 0);
  EXPECT_EQ(roadmap.vertex_count(), plain.vertex_count() + with_twin);
  EXPECT_EQ(roadmap.CountEdges(), edges / 2);
}

TEST(Roadmap, FingersOfARadiusNeverOverlapAndNothingElseIsLost) {
  const std::vector<grasp::Contact> points = CubePoints(22);
  const Roadmap plain = MakeRoadmap(points, 25);
  int left_out = 0;
  std::int64_t cut = 0;
  for (const double radius : {0.006, 0.012}) {
    const Roadmap roadmap(points, MakeBox({0.06, 0.06, 0.06}).wrench_frame(), Radians(25),
                          kSamePoint, radius);
    int kept = 0;
    for (int v = 0; v < plain.vertex_count(); ++v) {
      const bool apart = criteria::KeepApart(plain.grasp(v), radius);
      EXPECT_EQ(roadmap.Find(plain.vertex(v)).has_value(), apart);
      ++(apart ? kept : left_out);
    }
    EXPECT_EQ(roadmap.vertex_count(), kept);
    std::int64_t edges = 0;
    std::vector<int> neighbours;
    const search::Components components = roadmap.FindComponents();
    for (int v = 0; v < roadmap.vertex_count(); ++v) {
      roadmap.GetNeighbours(v, neighbours);
      std::int64_t expected = 0;
      for (int other = 0; other < roadmap.vertex_count(); ++other) {
        if (roadmap.MinSwitches(v, other) != 1) continue;
        grasp::Grasp during = roadmap.grasp(v);
        const grasp::Grasp after = roadmap.grasp(other);
        during.insert(during.end(), after.begin(), after.end());
        std::sort(
            during.begin(), during.end(), [](const grasp::Contact& a, const grasp::Contact& b) {
              return std::lexicographical_compare(a.p.begin(), a.p.end(), b.p.begin(), b.p.end());
            });
        during.erase(std::unique(during.begin(), during.end(),
                                 [](const grasp::Contact& a, const grasp::Contact& b) {
                                   return a.p == b.p;
                                 }),
                     during.end());
        const bool joined = std::ranges::count(neighbours, other) > 0;
        EXPECT_EQ(joined, criteria::KeepApart(during, radius));
        EXPECT_TRUE(!joined || components.of_vertex[v] == components.of_vertex[other]);
        ++(joined ? expected : cut);
      }
      EXPECT_EQ(std::ssize(neighbours), expected);
      edges += expected;
    }
    EXPECT_EQ(roadmap.CountEdges(), edges / 2);
    // The number of components equals that of an independent search.
    std::vector<bool> seen(roadmap.vertex_count(), false);
    int found = 0;
    for (int v = 0; v < roadmap.vertex_count(); ++v) {
      if (seen[v]) continue;
      ++found;
      for (const int other : search::ReachableVertices(roadmap, v, [](int) { return true; })) {
        seen[other] = true;
      }
    }
    EXPECT_EQ(components.count(), found);
  }
  EXPECT_GT(left_out, 20);
  EXPECT_GT(cut, 20);
}

/// Return a deadline that passes after a number of checks, and counts the checks.
Deadline AfterLooks(int looks, int& looked) {
  const Deadline::Clock::time_point begin;
  return {begin + Deadline::Clock::duration(looks),
          [begin, &looked] { return begin + Deadline::Clock::duration(looked++); }};
}

TEST(Roadmap, CountsEdgesAndComponentsNoLongerThanItsDeadline) {
  const std::vector<grasp::Contact> points = CubePoints(12);
  constexpr int kTriples = 220;
  for (const double radius : {0.0, 0.006}) {
    const Roadmap roadmap(points, MakeBox({0.06, 0.06, 0.06}).wrench_frame(), Radians(30),
                          kSamePoint, radius);
    ASSERT_GT(roadmap.vertex_count(), 0);
    int looked = 0;
    EXPECT_EQ(roadmap.CountEdges(AfterLooks(100'000, looked)), roadmap.CountEdges());
    EXPECT_GE(looked, kTriples);
    looked = 0;
    EXPECT_EQ(roadmap.FindComponents(AfterLooks(100'000, looked)).sizes,
              roadmap.FindComponents().sizes);
    const int all = looked;
    EXPECT_GE(all, kTriples);
    for (const int looks : {0, kTriples / 2, all - 1}) {
      looked = 0;
      EXPECT_THROW((void)roadmap.FindComponents(AfterLooks(looks, looked)), TimeUp);
      EXPECT_EQ(looked, looks + 1) << "it went on";
    }
    looked = 0;
    EXPECT_THROW((void)roadmap.CountEdges(AfterLooks(kTriples / 2, looked)), TimeUp);
    EXPECT_EQ(looked, kTriples / 2 + 1) << "it went on";
  }
}

TEST(Roadmap, IsEmptyWithoutForceClosure) {
  std::vector<grasp::Contact> one_face;
  for (const grasp::Contact& contact : CubePoints(60)) {
    if (contact.face == 0) one_face.push_back(contact);
  }
  ASSERT_GT(one_face.size(), 4u);
  const Roadmap roadmap = MakeRoadmap(one_face, 20);
  EXPECT_EQ(roadmap.vertex_count(), 0);
  EXPECT_EQ(roadmap.CountEdges(), 0);
  EXPECT_EQ(roadmap.FindComponents().count(), 0);
}

TEST(Roadmap, FindsOnlyFours) {
  const Roadmap roadmap = MakeRoadmap(CubePoints(12), 30);
  EXPECT_EQ(roadmap.Find(std::array{0, 1, 2}), std::nullopt);
  EXPECT_EQ(roadmap.Find(std::array{0, 0, 1, 2}), std::nullopt);
}

}  // namespace roadmap_test
}  // namespace regrasp::roadmap
