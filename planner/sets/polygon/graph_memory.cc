#include "planner/sets/polygon/graph_memory.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/random.h"
#include "planner/sets/polygon/concurrent.h"
#include "planner/sets/polygon/parallel.h"
#include "planner/sets/polygon/two_finger.h"

namespace regrasp::polygon {

namespace {

/// Counted in a tenth of a second.
constexpr int kCountedEdges = 40;

// Measured on polygons of 30 to 256 edges at 10° to 30°, as the peak of resident memory: 4 to 12 kB
// a vertex, most of it the pairs of contacts that it can have; 8 bytes a join, two entries in the
// lists of neighbours, and room that vectors keep to grow into.
constexpr double kBytesOfCandidate = 48;
constexpr double kBytesOfVertex = 7000;
constexpr double kBytesOfJoin = 28;

/// Joins times the square of the edges over the square of the vertices: 15 to 20 on the same.
constexpr double kJoinsOfSquaredVertices = 18;

/// Bytes for each pair of edges: the list of the vertices on it.
constexpr double kBytesOfPair = 24;

std::vector<int> DrawEdges(int count) {
  RandomStream random(0, RandomUse::kCountedEdges);
  std::vector<int> edges = random.Choose(count, std::min(count, kCountedEdges));
  std::ranges::sort(edges);
  return edges;
}

struct Counts {
  double candidates = 0;
  double on_two = 0, on_three = 0;  ///< vertices on so many edges
};

Counts CountOn(const EdgeTable& edges, planning::Spanning spanning) {
  Counts counts;
  ConcurrentCellFinder finder(edges);
  for (const ConcurrentCandidate& candidate : FindConcurrentCandidates(edges, spanning)) {
    counts.candidates += 1;
    counts.on_three += static_cast<double>(finder.Find(candidate).size());
  }
  for (const TwoFingerCandidate& candidate : FindTwoFingerCandidates(edges)) {
    counts.on_two += static_cast<double>(FindTwoFingerSets(edges, candidate).size());
  }
  const std::vector<ParallelCandidate> parallel = FindParallelCandidates(edges);
  for (std::size_t i = 0; i < parallel.size();) {
    std::vector<int> centres;
    const std::array<int, 3>& triple = parallel[i].edges;
    for (; i < parallel.size() && parallel[i].edges == triple; ++i) {
      centres.push_back(parallel[i].centre);
    }
    counts.candidates += 1;
    counts.on_three += static_cast<double>(FindParallelSets(edges, triple, centres).size());
  }
  return counts;
}

}  // namespace

MemoryNeed EstimatePolygonGraph(const object::Polygon& polygon, double half_angle,
                                planning::Spanning spanning) {
  const double tangent = std::tan(half_angle);  // before the processor rounds upward
  const IntervalScope scope;
  const std::vector<int> drawn = DrawEdges(polygon.face_count());
  const Counts counts = CountOn(EdgeTable(polygon, tangent).Of(drawn), spanning);
  const double m = static_cast<double>(drawn.size());
  const auto bytes_for = [counts, m](double n) {
    const double pairs = n * (n - 1) / (m * (m - 1));
    const double triples = pairs * (n - 2) / (m - 2);
    const double vertices = pairs * counts.on_two + triples * counts.on_three;
    const double joins = kJoinsOfSquaredVertices * vertices * vertices / (n * n);
    return kBytesOfCandidate * triples * counts.candidates + kBytesOfVertex * vertices +
           kBytesOfJoin * joins + kBytesOfPair * n * n;
  };
  return {"the graph of the planner polygon", polygon.face_count(), "edges", bytes_for};
}

}  // namespace regrasp::polygon
