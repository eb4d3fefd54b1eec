#include "planner/roadmap/grasp_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "planner/base/number.h"
#include "tests/planner/roadmap/grasp_graph.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp::roadmap {
namespace grasp_tree_test {

constexpr std::int64_t kEnoughSteps = std::numeric_limits<std::int64_t>::max();

/// Mesh of at most forty triangles, and all grasps of their centroids.
struct Problem {
  Problem(object::Polyhedron body, double degrees)
      : solid(std::move(body)),
        contacts(Centroids(solid)),
        frame(solid.wrench_frame()),
        friction_angle(Radians(degrees)),
        is_grasp(ForceClosureOf(contacts, frame, friction_angle)),
        numbers(contacts.size()),
        graph((std::iota(numbers.begin(), numbers.end(), 0), Subsets(numbers, is_grasp))) {}

  [[nodiscard]] GraspOracle Oracle() const { return {solid, contacts, {friction_angle, 0}}; }
  [[nodiscard]] double Distance(int a, int b) const {
    return (contacts[a].p - contacts[b].p).norm() + (contacts[a].n - contacts[b].n).norm();
  }
  [[nodiscard]] Junction Join(const Quadruple& from, const Quadruple& to,
                              std::int64_t most_steps = kEnoughSteps) const {
    GraspOracle oracle = Oracle();
    return JoinGrasps(
        from, to, Replacements::AnyOf(numbers, static_cast<int>(contacts.size())),
        [this](int a, int b) { return Distance(a, b); }, most_steps, oracle);
  }

  object::Polyhedron solid;
  std::vector<grasp::Contact> contacts;
  object::WrenchFrame frame;
  double friction_angle;
  IsGrasp is_grasp;
  std::vector<int> numbers;
  GraspGraph graph;
};

/// Draw pairs of grasps of one component and of two components.
std::vector<std::pair<Quadruple, Quadruple>> DrawPairs(GraspGraph& graph, int count,
                                                       std::uint64_t seed) {
  RandomStream random(seed, RandomUse::kStart);
  std::vector<std::vector<Quadruple>> components;
  for (auto& [number, grasps] : graph.Components()) components.push_back(std::move(grasps));
  std::vector<std::pair<Quadruple, Quadruple>> pairs;
  const auto draw = [&](const std::vector<Quadruple>& from) {
    return from[random.Index(from.size())];
  };
  for (int i = 0; i < count && !components.empty(); ++i) {
    const auto& a = components[random.Index(components.size())];
    const auto& b = components[random.Index(components.size())];
    pairs.emplace_back(draw(a), draw(i % 2 == 0 ? a : b));
  }
  return pairs;
}

TEST(JoinGrasps, FindsAWayWhereverThereIsOneAndSaysSoWhereNot) {
  int joined = 0;
  int apart = 0;
  int split = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const object::Polyhedron body = MakeConvexBody(14 + 2 * static_cast<int>(seed), seed);
    ASSERT_LE(body.triangles().size(), 40u);
    for (const double degrees : {5.0, 8.0, 12.0, 18.0, 25.0}) {
      Problem problem(body, degrees);
      const auto components = problem.graph.Components();
      if (components.size() > 1) ++split;
      for (const auto& [from, to] : DrawPairs(problem.graph, 30, seed)) {
        const Junction junction = problem.Join(from, to);
        if (problem.graph.Joined(from, to)) {
          EXPECT_EQ(FaultOf(junction.path, from, to, problem.is_grasp), std::nullopt);
          EXPECT_FALSE(junction.exhausted);
          ++joined;
          continue;
        }
        EXPECT_TRUE(junction.path.empty());
        EXPECT_TRUE(junction.exhausted);
        const std::size_t from_all = components.at(problem.graph.ComponentOf(from)).size();
        const std::size_t to_all = components.at(problem.graph.ComponentOf(to)).size();
        EXPECT_TRUE(junction.from_size == from_all || junction.to_size == to_all);
        EXPECT_LE(junction.from_size, from_all);
        EXPECT_LE(junction.to_size, to_all);
        ++apart;
      }
    }
  }
  EXPECT_GT(joined, 100);
  EXPECT_GT(apart, 30);
  EXPECT_GT(split, 3);
}

TEST(JoinGrasps, JoinsAGraspToItself) {
  Problem problem(MakeConvexBody(16, 1), 20);
  const Quadruple grasp = problem.graph.Components().begin()->second.front();
  EXPECT_EQ(problem.Join(grasp, grasp).path, std::vector<Quadruple>{grasp});
}

TEST(JoinGrasps, GivesUpAfterTheStepsAllowed) {
  Problem problem(MakeConvexBody(20, 2), 25);
  int gave_up = 0;
  for (const auto& [from, to] : DrawPairs(problem.graph, 20, 3)) {
    if (Differences(from, to) < 2) continue;
    const Junction junction = problem.Join(from, to, 1);
    EXPECT_TRUE(junction.path.empty());
    EXPECT_FALSE(junction.exhausted);
    EXPECT_LE(junction.from_size + junction.to_size, 3u);
    EXPECT_FALSE(problem.Join(from, to).path.empty());
    ++gave_up;
  }
  EXPECT_GT(gave_up, 5);
}

TEST(JoinGrasps, IsTheSameEachTime) {
  Problem problem(MakeConvexBody(20, 3), 18);
  int longer = 0;
  for (const auto& [from, to] : DrawPairs(problem.graph, 10, 4)) {
    const Junction once = problem.Join(from, to);
    const Junction twice = problem.Join(from, to);
    EXPECT_EQ(once.path, twice.path);
    EXPECT_EQ(once.from_size, twice.from_size);
    if (once.path.size() > 2) ++longer;
  }
  EXPECT_GT(longer, 0);
}

TEST(JoinGrasps, KeepsToTheReplacementsAllowed) {
  // Replacements keep the parity of the contact numbers.
  Problem problem(MakeConvexBody(20, 4), 25);
  const int count = static_cast<int>(problem.contacts.size());
  Replacements replacements;
  replacements.lists.resize(2);
  for (int i = 0; i < count; ++i) {
    replacements.lists[i % 2].push_back(i);
    replacements.list_of.push_back(i % 2);
  }
  const auto even_count = [](const Quadruple& g) {
    return std::count_if(g.begin(), g.end(), [](int c) { return c % 2 == 0; });
  };
  GraspGraph allowed(Subsets(problem.numbers, [&](const Quadruple& g) {
    return even_count(g) == 2 && problem.is_grasp(g);
  }));
  int joined = 0;
  for (const auto& [from, to] : DrawPairs(allowed, 20, 5)) {
    GraspOracle oracle = problem.Oracle();
    const Junction junction = JoinGrasps(
        from, to, replacements, [&](int a, int b) { return problem.Distance(a, b); }, kEnoughSteps,
        oracle);
    EXPECT_EQ(!junction.path.empty(), allowed.Joined(from, to));
    for (const Quadruple& grasp : junction.path) EXPECT_EQ(even_count(grasp), 2);
    if (!junction.path.empty()) ++joined;
  }
  EXPECT_GT(joined, 5);
}

TEST(JoinGrasps, MovesNoFingerToItsOwnPoint) {
  // Two contacts at one point with slightly different normals cannot be exchanged, because two
  // fingers cannot be there at the same time.
  Problem problem(MakeConvexBody(16, 5), 25);
  const int twin = static_cast<int>(problem.contacts.size());
  grasp::Contact leaning = problem.contacts[0];
  leaning.n = (leaning.n + 0.01 * leaning.n.unitOrthogonal()).normalized();
  problem.contacts.push_back(leaning);
  problem.numbers.push_back(twin);
  int checked = 0;
  for (const auto& [number, grasps] : problem.graph.Components()) {
    for (const Quadruple& from : grasps) {
      if (from[0] != 0) continue;
      const Quadruple to = {from[1], from[2], from[3], twin};
      if (!problem.is_grasp(to)) continue;
      const Junction junction = problem.Join(from, to);
      EXPECT_NE(junction.path.size(), 2u);
      for (std::size_t i = 1; i < junction.path.size(); ++i) {
        const bool leaves = junction.path[i - 1][0] == 0 && junction.path[i][3] == twin;
        const bool comes = junction.path[i - 1][3] == twin && junction.path[i][0] == 0;
        EXPECT_FALSE(leaves || comes);
      }
      if (++checked >= 20) return;
    }
  }
  FAIL() << "only " << checked << " grasps with the twin";
}

TEST(GraspTree, ReachesTheRootsComponentBestFirst) {
  Problem problem(MakeConvexBody(16, 6), 15);
  const Quadruple root = DrawPairs(problem.graph, 1, 1).front().first;
  const std::vector<Quadruple> component =
      problem.graph.Components().at(problem.graph.ComponentOf(root));
  GraspOracle oracle = problem.Oracle();
  const int count = static_cast<int>(problem.contacts.size());
  std::vector<double> remoteness;
  for (int i = 0; i < count; ++i) remoteness.push_back(problem.Distance(i, 0));
  GraspTree tree(root, Replacements::AnyOf(problem.numbers, count), remoteness, oracle);
  EXPECT_TRUE(tree.Has(root));
  EXPECT_EQ(tree.PathTo(root), std::vector<Quadruple>{root});
  std::size_t reached = 1;
  while (!tree.exhausted()) {
    if (!tree.Step()) continue;
    ++reached;
    EXPECT_TRUE(tree.Has(tree.last()));
    EXPECT_EQ(FaultOf(tree.PathTo(tree.last()), root, tree.last(), problem.is_grasp), std::nullopt);
  }
  EXPECT_EQ(reached, component.size());
  EXPECT_EQ(tree.size(), component.size());
  EXPECT_GT(reached, 50u);
  for (const Quadruple& grasp : component) EXPECT_TRUE(tree.Has(grasp));
}

TEST(GraspTree, TakesTheLeastRemoteNeighbourFirst) {
  Problem problem(MakeConvexBody(20, 7), 25);
  const int count = static_cast<int>(problem.contacts.size());
  int checked = 0;
  for (const auto& [root, unused] : DrawPairs(problem.graph, 20, 6)) {
    std::vector<double> remoteness;
    for (int i = 0; i < count; ++i) remoteness.push_back(problem.Distance(i, root[3]));
    const auto sum = [&](const Quadruple& grasp) {
      double total = 0;
      for (const int contact : grasp) total += remoteness[contact];
      return total;
    };
    double least = std::numeric_limits<double>::infinity();
    for (const Quadruple& grasp : Subsets(problem.numbers, [&](const Quadruple& g) {
           return Differences(g, root) == 1 && problem.is_grasp(g);
         })) {
      least = std::min(least, sum(grasp));
    }
    GraspOracle oracle = problem.Oracle();
    GraspTree tree(root, Replacements::AnyOf(problem.numbers, count), remoteness, oracle);
    while (!tree.exhausted() && !tree.Step()) {
    }
    if (tree.exhausted()) continue;
    EXPECT_NEAR(sum(tree.last()), least, 1e-12);
    ++checked;
  }
  EXPECT_GT(checked, 10);
}

}  // namespace grasp_tree_test
}  // namespace regrasp::roadmap
