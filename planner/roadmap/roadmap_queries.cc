#include "planner/roadmap/roadmap_queries.h"

#include <algorithm>

#include "planner/base/stopwatch.h"
#include "planner/sampling/draw_grasp.h"

namespace regrasp::roadmap {

std::optional<Quadruple> DrawContactGrasp(const ClusteredRoadmap& roadmap,
                                          const criteria::GraspEvaluator& evaluator,
                                          RandomStream& random) {
  const std::vector<grasp::Contact>& contacts = roadmap.clusters.contacts();
  for (int draw = 0; draw < sampling::kMaxSurfaceDraws; ++draw) {
    Quadruple numbers;
    for (int& contact : numbers) contact = static_cast<int>(random.Index(contacts.size()));
    std::sort(numbers.begin(), numbers.end());
    grasp::Grasp grasp;
    for (const int contact : numbers) grasp.push_back(contacts[contact]);
    if (evaluator.IsAdmitted(grasp)) return numbers;
  }
  return std::nullopt;
}

std::vector<RandomQuery> RunRandomQueries(const ClusteredRoadmap& roadmap,
                                          const object::Polyhedron& solid, int count,
                                          std::uint64_t seed, bool last_resort,
                                          const Deadline& deadline, const Tell& tell) {
  const criteria::GraspCriteria force_closure = {roadmap.half_angle, 0};
  const criteria::GraspEvaluator evaluator(solid, force_closure);
  RandomStream starts(seed, RandomUse::kStart);
  RandomStream goals(seed, RandomUse::kGoal);
  std::vector<RandomQuery> queries;
  CountedProgress progress(tell, "random queries", count);
  for (int i = 0; i < count; ++i) {
    deadline.Check();
    progress.Add();
    const auto start = DrawContactGrasp(roadmap, evaluator, starts);
    const auto goal = DrawContactGrasp(roadmap, evaluator, goals);
    if (!start || !goal) break;
    Stopwatch stopwatch;
    GraspOracle oracle(solid, roadmap.clusters.contacts(), force_closure, {}, deadline);
    ContactChain chain =
        FindContactChain(roadmap, roadmap.clusters, oracle, *start, *goal, last_resort);
    queries.push_back({*start, *goal, std::move(chain), stopwatch.Lap()});
  }
  return queries;
}

}  // namespace regrasp::roadmap
