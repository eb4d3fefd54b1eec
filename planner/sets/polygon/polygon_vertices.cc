#include "planner/sets/polygon/polygon_vertices.h"

#include <iterator>
#include <utility>

namespace regrasp::polygon {

namespace {

/// @param find  gives the sets on a candidate's edges.
template <class Candidate, class Component, class Find>
GraspTypeCounts FindOnCandidates(const std::vector<Candidate>& candidates, const Deadline& deadline,
                                 const Find& find,
                                 std::vector<PolygonVertex<Candidate, Component>>& vertices) {
  GraspTypeCounts counts;
  counts.candidates = std::ssize(candidates);
  for (const Candidate& candidate : candidates) {
    deadline.Check();
    std::vector<Component> found = find(candidate);
    if (!found.empty()) ++counts.combinations;
    for (Component& component : found) vertices.push_back({candidate, std::move(component)});
  }
  counts.vertices = std::ssize(vertices);
  return counts;
}

}  // namespace

PolygonVertices FindVertices(const EdgeTable& edges, planning::Spanning spanning,
                             const Deadline& deadline) {
  PolygonVertices vertices;
  ConcurrentCellFinder finder(edges);
  const auto counts = [&](GraspType type) -> GraspTypeCounts& {
    return vertices.counts[static_cast<int>(type)];
  };
  counts(GraspType::kConcurrent) = FindOnCandidates(
      FindConcurrentCandidates(edges, spanning, deadline), deadline,
      [&](const ConcurrentCandidate& c) { return finder.Find(c); }, vertices.concurrent);
  counts(GraspType::kTwoFinger) = FindOnCandidates(
      FindTwoFingerCandidates(edges, deadline), deadline,
      [&](const TwoFingerCandidate& c) { return FindTwoFingerSets(edges, c); },
      vertices.two_finger);
  counts(GraspType::kParallel) = FindOnCandidates(
      FindParallelCandidates(edges, deadline), deadline,
      [&](const ParallelCandidate& c) { return FindParallelSets(edges, c); }, vertices.parallel);
  return vertices;
}

}  // namespace regrasp::polygon
