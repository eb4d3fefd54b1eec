#include "planner/roadmap/roadmap_queries.h"

#include <algorithm>
#include <chrono>

#include "planner/sampling/draw_grasp.h"

namespace regrasp {

std::optional<Quadruple> DrawContactGrasp(const ClusteredRoadmap& roadmap, double same_point,
                                          RandomStream& random) {
  const std::vector<Contact>& contacts = roadmap.clusters.contacts();
  GraspOracle oracle(contacts, roadmap.frame, roadmap.half_angle, same_point);
  for (int draw = 0; draw < kMaxSurfaceDraws; ++draw) {
    Quadruple grasp;
    for (int& contact : grasp) contact = static_cast<int>(random.Index(contacts.size()));
    std::sort(grasp.begin(), grasp.end());
    if (oracle.Admits(grasp)) return grasp;
  }
  return std::nullopt;
}

std::vector<RandomQuery> RunRandomQueries(const ClusteredRoadmap& roadmap, double same_point,
                                          int count, std::uint64_t seed, bool last_resort) {
  RandomStream starts(seed, RandomUse::kStart);
  RandomStream goals(seed, RandomUse::kGoal);
  std::vector<RandomQuery> queries;
  for (int i = 0; i < count; ++i) {
    const auto start = DrawContactGrasp(roadmap, same_point, starts);
    const auto goal = DrawContactGrasp(roadmap, same_point, goals);
    if (!start || !goal) break;
    const auto begin = std::chrono::steady_clock::now();
    GraspOracle oracle(roadmap.clusters.contacts(), roadmap.frame, roadmap.half_angle, same_point);
    ContactChain chain =
        FindContactChain(roadmap, roadmap.clusters, oracle, *start, *goal, last_resort);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    queries.push_back({*start, *goal, std::move(chain), time.count()});
  }
  return queries;
}

}  // namespace regrasp
