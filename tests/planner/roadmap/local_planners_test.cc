#include "planner/roadmap/local_planners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <ostream>

#include "planner/base/number.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/roadmap/roadmap_planner.h"
#include "tests/fixtures/deadline_laws.h"
#include "tests/planner/roadmap/grasp_graph.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp::roadmap {
namespace local_planners_test {

constexpr double kNear = 1e-9;

std::vector<grasp::Contact> RepresentativesOf(const ContactClusters& clusters) {
  std::vector<grasp::Contact> points;
  for (const int contact : clusters.representatives()) {
    points.push_back(clusters.contacts()[contact]);
  }
  return points;
}

/// Clusters of a small mesh, their roadmap, and the same by brute force.
struct Problem {
  Problem(object::Polyhedron body, double degrees, int cluster_count)
      : solid(std::move(body)),
        frame(solid.wrench_frame()),
        friction_angle(Radians(degrees)),
        clusters(Centroids(solid), frame, friction_angle, cluster_count, 1),
        roadmap(RepresentativesOf(clusters), frame, friction_angle, kNear),
        oracle(solid, clusters.contacts(), {friction_angle, 0}),
        local(clusters, roadmap, oracle),
        is_grasp(ForceClosureOf(clusters.contacts(), frame, friction_angle)),
        vertices(Subsets(clusters.representatives(), is_grasp)) {}

  /// Return all grasps of four contacts, or every n-th of them if they are too many.
  [[nodiscard]] std::vector<Quadruple> Sample(std::size_t most) const {
    std::vector<int> all;
    for (int i = 0; i < clusters.clustered_count(); ++i) all.push_back(i);
    const std::set<Quadruple> grasps = Subsets(all, is_grasp);
    std::vector<Quadruple> sample;
    const std::size_t stride = grasps.size() / most + 1;
    std::size_t k = 0;
    for (const Quadruple& grasp : grasps) {
      if (k++ % stride == 0) sample.push_back(grasp);
    }
    return sample;
  }

  [[nodiscard]] FourClusters ClustersOf(const Quadruple& grasp) const {
    return roadmap::ClustersOf(clusters, grasp);
  }
  [[nodiscard]] Quadruple Representatives(const FourClusters& of) const {
    Quadruple grasp;
    for (int i = 0; i < 4; ++i) grasp[i] = clusters.representative(of[i]);
    std::sort(grasp.begin(), grasp.end());
    return grasp;
  }

  /// Return S_i as defined in section 6.2.4: the contacts j of the cluster, including the added
  /// one, with F_ij <= F_ii' and F_i'j <= F_ii'.
  [[nodiscard]] std::vector<int> SetBetween(int contact, ClusterIndex cluster) const {
    const int representative = clusters.representative(cluster);
    const double apart = clusters.Distance(contact, representative);
    std::vector<int> set;
    for (int j = 0; j < clusters.clustered_count(); ++j) {
      if (j != contact && clusters.cluster_of(j) != cluster) continue;
      if (clusters.Distance(contact, j) <= apart && clusters.Distance(representative, j) <= apart) {
        set.push_back(j);
      }
    }
    return set;
  }
  [[nodiscard]] std::array<std::vector<int>, 4> SetsBetween(const Quadruple& grasp,
                                                            const FourClusters& of) const {
    std::array<std::vector<int>, 4> sets;
    for (int i = 0; i < 4; ++i) sets[i] = SetBetween(grasp[i], of[i]);
    return sets;
  }
  /// Return the grasps that have a path within the sets, by brute force.
  [[nodiscard]] std::set<Quadruple> LocalGrasps(const std::array<std::vector<int>, 4>& sets) const {
    return Product(sets, is_grasp);
  }

  object::Polyhedron solid;
  object::WrenchFrame frame;
  double friction_angle;
  ContactClusters clusters;
  Roadmap roadmap;
  GraspOracle oracle;
  LocalPlanners local;
  IsGrasp is_grasp;
  std::set<Quadruple> vertices;
};

/// Meshes of at most forty triangles, with few and many clusters, and with low and high friction.
struct Setting {
  int corners;
  std::uint64_t seed;
  double degrees;
  int clusters;
};
constexpr Setting kSettings[] = {{16, 1, 20, 7},  {18, 2, 12, 9},  {20, 3, 10, 12}, {22, 4, 8, 14},
                                 {22, 5, 15, 10}, {22, 6, 10, 18}, {20, 7, 25, 6}};
constexpr std::size_t kSample = 250;

void PrintTo(const Setting& setting, std::ostream* out) {
  *out << setting.corners << " corners, seed " << setting.seed << ", " << setting.degrees << "°, "
       << setting.clusters << " clusters";
}

class LocalPlannersOn : public testing::TestWithParam<Setting> {
 protected:
  Problem problem_{MakeConvexBody(GetParam().corners, GetParam().seed), GetParam().degrees,
                   GetParam().clusters};
  std::vector<Quadruple> sample_ = problem_.Sample(kSample);
};
INSTANTIATE_TEST_SUITE_P(SmallMeshes, LocalPlannersOn, testing::ValuesIn(kSettings));

TEST_P(LocalPlannersOn, OwnRepresentativesAreAVertexOrNothing) {
  int with = 0;
  for (const Quadruple& grasp : sample_) {
    const Quadruple own = problem_.Representatives(problem_.ClustersOf(grasp));
    const bool expected = problem_.vertices.contains(own);
    EXPECT_EQ(problem_.local.OwnRepresentatives(grasp),
              expected ? std::optional(own) : std::nullopt);
    if (expected) ++with;
  }
  EXPECT_GT(with, 0);
  EXPECT_LT(with, std::ssize(sample_));
}

TEST_P(LocalPlannersOn, Algorithm1FindsAPathWhereTheLocalRoadmapHasOne) {
  int found = 0;
  for (const Quadruple& grasp : sample_) {
    const auto own = problem_.local.OwnRepresentatives(grasp);
    const std::vector<Quadruple> path = problem_.local.RunAlgorithm1(grasp);
    if (!own) {
      EXPECT_TRUE(path.empty());
      continue;
    }
    const std::set<Quadruple> local =
        problem_.LocalGrasps(problem_.SetsBetween(grasp, problem_.ClustersOf(grasp)));
    GraspGraph graph(local);
    ASSERT_EQ(!path.empty(), graph.Joined(grasp, *own));
    if (path.empty()) continue;
    EXPECT_EQ(FaultOf(path, grasp, *own, problem_.is_grasp), std::nullopt);
    for (const Quadruple& on_path : path) EXPECT_TRUE(local.contains(on_path));
    ++found;
  }
  EXPECT_GT(found, 0);
}

TEST_P(LocalPlannersOn, FindNearestClusterIsTheNearestOfAllVertices) {
  int found = 0;
  for (const Quadruple& grasp : sample_) {
    const FourClusters own = problem_.ClustersOf(grasp);
    double least = std::numeric_limits<double>::infinity();
    for (int vertex = 0; vertex < problem_.roadmap.vertex_count(); ++vertex) {
      for (int slot = 0; slot < 4; ++slot) {
        // The clusters of the vertex without those of the other three contacts.
        std::vector<int> rest(problem_.roadmap.vertex(vertex).begin(),
                              problem_.roadmap.vertex(vertex).end());
        for (int i = 0; i < 4; ++i) {
          const auto place = std::find(rest.begin(), rest.end(), own[i]);
          if (i != slot && place != rest.end()) rest.erase(place);
        }
        if (rest.size() != 1 || rest[0] == own[slot]) continue;
        least =
            std::min(least, problem_.clusters.DistanceToCenter(grasp[slot], ClusterIndex(rest[0])));
      }
    }
    const auto nearest = problem_.local.FindNearestCluster(grasp);
    ASSERT_EQ(nearest.has_value(), least < std::numeric_limits<double>::infinity());
    if (!nearest) continue;
    EXPECT_EQ(problem_.clusters.DistanceToCenter(grasp[nearest->slot], nearest->cluster), least);
    FourClusters moved = own;
    moved[nearest->slot] = nearest->cluster;
    EXPECT_EQ(nearest->vertex, problem_.Representatives(moved));
    EXPECT_TRUE(problem_.vertices.contains(nearest->vertex));
    ++found;
  }
  EXPECT_GT(found, 0);
}

TEST_P(LocalPlannersOn, Algorithm2FindsAPathWhereTheLocalRoadmapHasOne) {
  int found = 0;
  int shared = 0;
  for (const Quadruple& grasp : sample_) {
    const auto nearest = problem_.local.FindNearestCluster(grasp);
    const std::vector<Quadruple> path = problem_.local.RunAlgorithm2(grasp);
    if (!nearest) {
      EXPECT_TRUE(path.empty());
      continue;
    }
    FourClusters moved = problem_.ClustersOf(grasp);
    moved[nearest->slot] = nearest->cluster;
    const auto sets = problem_.SetsBetween(grasp, moved);
    const std::set<Quadruple> local = problem_.LocalGrasps(sets);
    GraspGraph graph(local);
    EXPECT_EQ(!path.empty(), graph.Joined(grasp, nearest->vertex));
    for (int i = 0; i < 4; ++i) {
      const int mover = grasp[nearest->slot];
      if (i != nearest->slot && std::count(sets[i].begin(), sets[i].end(), mover) > 0) ++shared;
    }
    if (path.empty()) continue;
    EXPECT_EQ(FaultOf(path, grasp, nearest->vertex, problem_.is_grasp), std::nullopt);
    for (const Quadruple& on_path : path) EXPECT_TRUE(local.contains(on_path));
    ++found;
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(shared, 0) << "no contact that moves stands for two clusters";
}

TEST_P(LocalPlannersOn, Algorithm3FindsAPathWhereTheLargerRoadmapHasOne) {
  int found = 0;
  for (const Quadruple& grasp : sample_) {
    if (problem_.vertices.contains(grasp)) continue;
    std::vector<int> contacts = problem_.clusters.representatives();
    for (const int contact : grasp) {
      if (std::count(contacts.begin(), contacts.end(), contact) == 0) contacts.push_back(contact);
    }
    GraspGraph graph(Subsets(contacts, problem_.is_grasp));
    const bool expected =
        std::any_of(problem_.vertices.begin(), problem_.vertices.end(),
                    [&](const Quadruple& vertex) { return graph.Joined(grasp, vertex); });
    const std::vector<Quadruple> path = problem_.local.RunAlgorithm3(grasp);
    ASSERT_EQ(!path.empty(), expected);
    if (path.empty()) continue;
    EXPECT_EQ(FaultOf(path, grasp, path.back(), problem_.is_grasp), std::nullopt);
    EXPECT_TRUE(problem_.vertices.contains(path.back()));
    for (const Quadruple& on_path : path) {
      EXPECT_TRUE(graph.Has(on_path));
      EXPECT_TRUE(on_path == path.back() || !problem_.vertices.contains(on_path));
    }
    ++found;
  }
  EXPECT_GT(found, 0);
}

TEST_P(LocalPlannersOn, LinkTakesTheFirstThatFindsAPath) {
  std::map<RoadmapLink, int> links;
  std::vector<Quadruple> grasps = sample_;
  grasps.insert(grasps.end(), problem_.vertices.begin(), problem_.vertices.end());
  for (const Quadruple& grasp : grasps) {
    const LocalPlanners::Path path = problem_.local.Link(grasp);
    RoadmapLink expected = RoadmapLink::kNone;
    std::vector<Quadruple> expected_path;
    if (problem_.vertices.contains(grasp)) {
      expected = RoadmapLink::kVertex;
      expected_path = {grasp};
    } else if (const auto one = problem_.local.RunAlgorithm1(grasp); !one.empty()) {
      expected = RoadmapLink::kAlgorithm1;
      expected_path = one;
    } else if (const auto two = problem_.local.RunAlgorithm2(grasp); !two.empty()) {
      expected = RoadmapLink::kAlgorithm2;
      expected_path = two;
    } else if (const auto three = problem_.local.RunAlgorithm3(grasp); !three.empty()) {
      expected = RoadmapLink::kAlgorithm3;
      expected_path = three;
    }
    EXPECT_EQ(path.link, expected);
    EXPECT_EQ(path.grasps, expected_path);
    ++links[path.link];
  }
  EXPECT_GT(links[RoadmapLink::kVertex], 0);
  EXPECT_GT(links[RoadmapLink::kAlgorithm1], 0);
  EXPECT_GT(links[RoadmapLink::kAlgorithm2], 0);
  EXPECT_GT(links[RoadmapLink::kAlgorithm3], 0);
}

TEST(RoadmapLinkName, NamesAllLinks) {
  EXPECT_STREQ(RoadmapLinkName(RoadmapLink::kNone), "none");
  EXPECT_STREQ(RoadmapLinkName(RoadmapLink::kVertex), "vertex");
  EXPECT_STREQ(RoadmapLinkName(RoadmapLink::kAlgorithm1), "algorithm-1");
  EXPECT_STREQ(RoadmapLinkName(RoadmapLink::kAlgorithm2), "algorithm-2");
  EXPECT_STREQ(RoadmapLinkName(RoadmapLink::kAlgorithm3), "algorithm-3");
}

}  // namespace local_planners_test

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
