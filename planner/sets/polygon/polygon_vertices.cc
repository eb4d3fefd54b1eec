#include "planner/sets/polygon/polygon_vertices.h"

#include <iterator>
#include <string>
#include <utility>

namespace regrasp::polygon {

std::vector<TwoFingerPart> FindTwoFingerSets(const EdgeTable& edges,
                                             const TwoFingerCandidate& candidate) {
  std::vector<TwoFingerPart> parts;
  for (const bool stretching : {false, true}) {
    auto region = FilteredRegion::Make([&edges, candidate, stretching](auto zero) {
      using NT = decltype(zero);
      return MakeTwoFingerRegion(edges.frame<NT>(candidate[0]), edges.frame<NT>(candidate[1]),
                                 stretching);
    });
    if (region) parts.push_back({stretching, std::move(*region)});
  }
  return parts;
}

FilteredRange TwoFingerContactRange(const TwoFingerPart& part, int k) {
  return FilteredRange(
      [&part, k](auto zero) { return TwoFingerRange(part.region.as<decltype(zero)>(), k); });
}

namespace {

/// Find the sets of all candidates and count them.
/// @param find  function that returns the sets on a candidate's edges.
template <class Candidate, class Component, class Find>
GraspTypeCounts FindOnCandidates(const std::vector<Candidate>& candidates, const Deadline& deadline,
                                 CountedProgress& progress, const Find& find,
                                 std::vector<PolygonVertex<Candidate, Component>>& vertices) {
  GraspTypeCounts counts;
  counts.candidates = std::ssize(candidates);
  for (const Candidate& candidate : candidates) {
    deadline.Check();
    progress.Add();
    std::vector<Component> found = find(candidate);
    if (!found.empty()) ++counts.combinations;
    for (Component& component : found) vertices.push_back({candidate, std::move(component)});
  }
  counts.vertices = std::ssize(vertices);
  return counts;
}

}  // namespace

PolygonVertices FindVertices(const EdgeTable& edges, planning::Spanning spanning,
                             const Deadline& deadline, const Tell& tell) {
  PolygonVertices vertices;
  ConcurrentCellFinder finder(edges);
  const auto counts = [&](GraspType type) -> GraspTypeCounts& {
    return vertices.counts[static_cast<int>(type)];
  };
  const auto find_all = [&](GraspType type, const char* what, const auto& candidates,
                            const auto& find, auto& found) {
    CountedProgress progress(tell, "testing " + std::string(what), std::ssize(candidates));
    counts(type) = FindOnCandidates(candidates, deadline, progress, find, found);
  };
  find_all(
      GraspType::kConcurrent, "triples of edges for concurrent grasps",
      FindConcurrentCandidates(edges, spanning, deadline),
      [&](const ConcurrentCandidate& c) { return finder.Find(c); }, vertices.concurrent);
  find_all(
      GraspType::kTwoFinger, "pairs of edges", FindTwoFingerCandidates(edges, deadline),
      [&](const TwoFingerCandidate& c) { return FindTwoFingerSets(edges, c); },
      vertices.two_finger);
  find_all(
      GraspType::kParallel, "triples of edges for parallel grasps",
      FindParallelCandidates(edges, deadline),
      [&](const ParallelCandidate& c) { return FindParallelSets(edges, c); }, vertices.parallel);
  return vertices;
}

}  // namespace regrasp::polygon
