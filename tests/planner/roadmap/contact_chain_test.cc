#include "planner/roadmap/contact_chain.h"

#include <gtest/gtest.h>

#include <numeric>

#include "planner/base/number.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/roadmap/roadmap_planner.h"
#include "tests/fixtures/deadline_laws.h"
#include "tests/planner/roadmap/grasp_graph.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp::roadmap {
namespace contact_chain_test {

using By = ContactChain::By;

/// Clustered roadmap of a small mesh, and all grasps of its contacts.
struct Problem {
  Problem(object::Polyhedron body, double degrees, int clusters)
      : solid(std::move(body)),
        // The number of contact points equals that of triangles, so they are the centroids.
        roadmap(solid, {.friction_angle = Radians(degrees),
                        .contacts = static_cast<int>(solid.triangles().size()),
                        .clusters = clusters,
                        .seed = 1}),
        is_grasp(
            ForceClosureOf(roadmap.clusters.contacts(), roadmap.frame, roadmap.friction_angle)),
        numbers(roadmap.clusters.clustered_count()),
        all((std::iota(numbers.begin(), numbers.end(), 0), Subsets(numbers, is_grasp))),
        graph(all) {}

  [[nodiscard]] ContactChain Find(const Quadruple& start, const Quadruple& goal,
                                  bool last_resort) const {
    GraspOracle oracle(solid, roadmap.clusters.contacts(), {roadmap.friction_angle, 0});
    return FindContactChain(roadmap, roadmap.clusters, oracle, start, goal, last_resort);
  }

  /// Return whether start and goal are connected among the representatives and the contacts of the
  /// ends that algorithms 1 and 2 do not link.
  [[nodiscard]] bool JoinedByRoadmap(const Quadruple& start, const Quadruple& goal) const {
    GraspOracle oracle(solid, roadmap.clusters.contacts(), {roadmap.friction_angle, 0});
    LocalPlanners local(roadmap.clusters, roadmap.roadmap, oracle);
    std::set<int> contacts(roadmap.clusters.representatives().begin(),
                           roadmap.clusters.representatives().end());
    const auto end = [&](const Quadruple& grasp) {
      const LocalPlanners::Path path = local.Link(grasp);
      if (path.link != RoadmapLink::kAlgorithm3 && path.link != RoadmapLink::kNone) {
        return path.grasps.back();
      }
      contacts.insert(grasp.begin(), grasp.end());
      return grasp;
    };
    const Quadruple from = end(start);
    const Quadruple to = end(goal);
    GraspGraph graph(Subsets({contacts.begin(), contacts.end()}, is_grasp));
    return graph.Joined(from, to);
  }

  [[nodiscard]] std::vector<std::pair<Quadruple, Quadruple>> DrawPairs(int count) const {
    const std::vector<Quadruple> list(all.begin(), all.end());
    RandomStream random(1, RandomUse::kGoal);
    std::vector<std::pair<Quadruple, Quadruple>> pairs;
    for (int i = 0; i < count; ++i) {
      const Quadruple& start = list[random.Index(list.size())];
      pairs.emplace_back(start, list[random.Index(list.size())]);
    }
    return pairs;
  }

  object::Polyhedron solid;
  ClusteredRoadmap roadmap;
  IsGrasp is_grasp;
  std::vector<int> numbers;
  std::set<Quadruple> all;
  GraspGraph graph;
};

struct Setting {
  int corners;
  std::uint64_t seed;
  double degrees;
  int clusters;
};
constexpr Setting kSettings[] = {{16, 1, 12, 7}, {18, 2, 8, 9},  {20, 3, 6, 12},
                                 {22, 4, 5, 14}, {22, 6, 7, 18}, {20, 7, 10, 6}};

TEST(FindContactChain, FindsOneWhereverAllGraspsAreJoined) {
  std::map<By, int> by;
  for (const auto& [corners, seed, degrees, clusters] : kSettings) {
    Problem problem(MakeConvexBody(corners, seed), degrees, clusters);
    for (const auto& [start, goal] : problem.DrawPairs(60)) {
      const ContactChain chain = problem.Find(start, goal, true);
      ASSERT_EQ(!chain.grasps.empty(), problem.graph.Joined(start, goal));
      EXPECT_EQ(chain.grasps.empty(), chain.by == By::kNothing);
      ++by[chain.by];
      if (chain.by == By::kNothing) {
        EXPECT_TRUE(chain.exhausted);
        EXPECT_GT(chain.start_size, 0u);
        EXPECT_GT(chain.goal_size, 0u);
      } else {
        EXPECT_EQ(FaultOf(chain.grasps, start, goal, problem.is_grasp), std::nullopt);
        EXPECT_FALSE(chain.exhausted);
      }
    }
  }
  EXPECT_GT(by[By::kNothing], 0);
  EXPECT_GT(by[By::kRoadmap], 0);
  EXPECT_GT(by[By::kSubsets], 0);
  EXPECT_GT(by[By::kLastResort], 0);
}

TEST(FindContactChain, WithoutLastResortFindsOneWhereverTheRoadmapJoins) {
  int found = 0;
  int missed = 0;
  for (const auto& [corners, seed, degrees, clusters] : kSettings) {
    Problem problem(MakeConvexBody(corners, seed), degrees, clusters);
    for (const auto& [start, goal] : problem.DrawPairs(60)) {
      const ContactChain chain = problem.Find(start, goal, false);
      EXPECT_EQ(!chain.grasps.empty(), problem.JoinedByRoadmap(start, goal))
          << RoadmapLinkName(chain.start_link) << ", " << RoadmapLinkName(chain.goal_link);
      if (!chain.grasps.empty()) {
        EXPECT_EQ(chain.by, By::kRoadmap);
        EXPECT_EQ(FaultOf(chain.grasps, start, goal, problem.is_grasp), std::nullopt);
        ++found;
      } else if (!problem.Find(start, goal, true).grasps.empty()) {
        ++missed;
      }
    }
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(missed, 5) << "a last resort that is never needed was not tried";
}

TEST(FindContactChain, OfAGraspToItselfEndsWhereItStarts) {
  Problem problem(MakeConvexBody(20, 3), 12, 8);
  for (const auto& [grasp, unused] : problem.DrawPairs(20)) {
    const ContactChain chain = problem.Find(grasp, grasp, true);
    EXPECT_EQ(FaultOf(chain.grasps, grasp, grasp, problem.is_grasp), std::nullopt);
  }
}

TEST(FindContactChain, ThirtyOfThirtyQueriesOnModelsFindOne) {
  for (const char* name : {"ellipsoid500", "mug500", "spanner500"}) {
    const object::Polyhedron solid = ReadMesh(name);
    const ClusteredRoadmap roadmap(solid, {.friction_angle = Radians(10), .clusters = 30});
    const auto is_grasp =
        ForceClosureOf(roadmap.clusters.contacts(), roadmap.frame, roadmap.friction_angle);
    int found = 0;
    for (const RandomQuery& query : RunRandomQueries(roadmap, solid, 30, 1, true)) {
      const ContactChain& chain = query.chain;
      EXPECT_EQ(FaultOf(chain.grasps, query.start, query.goal, is_grasp), std::nullopt)
          << name << (chain.exhausted ? ": exhausted" : ": gave up") << " at " << chain.start_size
          << " and " << chain.goal_size;
      if (!chain.grasps.empty()) ++found;
    }
    EXPECT_EQ(found, 30) << name;
  }
}

TEST(FindContactChain, WithoutLastResortCanMissWhatThereIs) {
  const object::Polyhedron solid = ReadMesh("spanner500");
  const ClusteredRoadmap roadmap(solid, {.friction_angle = Radians(10), .clusters = 30});
  int by_roadmap = 0;
  int by_last_resort = 0;
  const auto with = RunRandomQueries(roadmap, solid, 30, 1, true);
  const auto without = RunRandomQueries(roadmap, solid, 30, 1, false);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].start, without[i].start);
    EXPECT_EQ(with[i].goal, without[i].goal);
    const bool found = without[i].chain.by == By::kRoadmap;
    EXPECT_EQ(without[i].chain.grasps.empty(), !found);
    if (found) {
      EXPECT_EQ(with[i].chain.grasps, without[i].chain.grasps);
      ++by_roadmap;
    } else if (!with[i].chain.grasps.empty()) {
      ++by_last_resort;
    }
  }
  EXPECT_GT(by_roadmap, 0);
  EXPECT_GT(by_last_resort, 0);
}

TEST(RunRandomQueries, AreTheSameWhateverTheClusters) {
  const object::Polyhedron solid = ReadMesh("mug500");
  const auto ends = [&](int clusters, std::uint64_t seed) {
    const ClusteredRoadmap roadmap(solid, {.friction_angle = Radians(10), .clusters = clusters});
    std::vector<std::pair<Quadruple, Quadruple>> ends;
    for (const RandomQuery& query : RunRandomQueries(roadmap, solid, 5, seed, false)) {
      ends.emplace_back(query.start, query.goal);
    }
    return ends;
  };
  EXPECT_EQ(ends(20, 1).size(), 5u);
  EXPECT_EQ(ends(20, 1), ends(30, 1));
  EXPECT_NE(ends(20, 1), ends(20, 2));
}

TEST(RunRandomQueries, LookAtTheDeadlineForEveryQueryAndEndWhereverItComes) {
  const object::Polyhedron solid = MakeConvexBody(20, 3);
  const ClusteredRoadmap roadmap(solid,
                                 {.friction_angle = Radians(10), .contacts = 36, .clusters = 6});
  const auto run = [&](const Deadline& deadline) {
    return RunRandomQueries(roadmap, solid, 10, 1, true, deadline).size();
  };
  const CountedDeadline never;
  ASSERT_EQ(run(never.deadline()), 10u);
  EXPECT_GE(never.looks(), 10);
  ExpectEndsWhereverItComes(never.looks(),
                            [&](const Deadline& deadline) { static_cast<void>(run(deadline)); });
}

TEST(DrawContactGrasp, DrawsForceClosureGraspsOrNone) {
  const object::Polyhedron solid = MakeConvexBody(20, 3);
  const ClusteredRoadmapOptions options = {
      .friction_angle = Radians(10), .contacts = 36, .clusters = 6};
  const ClusteredRoadmap roadmap(solid, options);
  const auto is_grasp =
      ForceClosureOf(roadmap.clusters.contacts(), roadmap.frame, roadmap.friction_angle);
  const criteria::GraspCriteria criteria = {roadmap.friction_angle, 0};
  const criteria::GraspEvaluator evaluator(solid, criteria);
  RandomStream random(1, RandomUse::kStart);
  std::set<Quadruple> drawn;
  for (int i = 0; i < 100; ++i) {
    const auto grasp = DrawContactGrasp(roadmap, evaluator, random);
    ASSERT_TRUE(grasp.has_value());
    EXPECT_TRUE(is_grasp(*grasp));
    drawn.insert(*grasp);
  }
  EXPECT_GT(drawn.size(), 50u);
  const criteria::GraspEvaluator thick(solid, criteria, {.fingertip_radius = solid.diameter()});
  EXPECT_EQ(DrawContactGrasp(roadmap, thick, random), std::nullopt);
}

}  // namespace contact_chain_test
}  // namespace regrasp::roadmap
