#include "planner/sets/polygon/graph_memory.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/random.h"
#include "planner/sets/graph_size.h"
#include "planner/sets/polygon/polygon_vertices.h"

namespace regrasp::polygon {

namespace {

/// Counted in a tenth of a second.
constexpr int kCountedEdges = 40;

/// Measured on polygons of 30 to 256 edges at 10° to 30°, as the peak of resident memory: 4 to 12
/// kB a set, most of it the pairs of contacts that it can have; 8 bytes a switch, and two entries
/// in the lists of neighbours.
constexpr sets::GraphSize kBytes = {.candidates = 48, .sets = 7000, .switches = 28};

/// Switches times the square of the edges over the square of the sets: 15 to 20 on the same.
constexpr double kSwitchesOfSquaredSets = 18;

/// Bytes for each pair of edges: the list of the sets on it.
constexpr double kBytesOfPair = 24;

}  // namespace

MemoryNeed EstimatePolygonGraph(const object::Polygon& polygon, double half_angle,
                                planning::Spanning spanning) {
  const double tangent = std::tan(half_angle);  // before the processor rounds upward
  const IntervalScope scope;
  std::vector<int> drawn =
      RandomStream(0, RandomUse::kCountedEdges)
          .Choose(polygon.face_count(), std::min(polygon.face_count(), kCountedEdges));
  std::ranges::sort(drawn);
  const EdgeTable edges = EdgeTable(polygon, tangent).Of(drawn);
  const auto counts = FindVertices(edges, spanning).counts;
  const auto count = [&](GraspType type) { return counts[static_cast<int>(type)]; };
  const GraspTypeCounts concurrent = count(GraspType::kConcurrent);
  const GraspTypeCounts parallel = count(GraspType::kParallel);
  const auto candidates = static_cast<double>(concurrent.candidates + parallel.candidates);
  const auto on_three = static_cast<double>(concurrent.vertices + parallel.vertices);
  const auto on_two = static_cast<double>(count(GraspType::kTwoFinger).vertices);
  const double m = static_cast<double>(drawn.size());
  const auto bytes_for = [=](double n) {
    const double pairs = n * (n - 1) / (m * (m - 1));
    const double triples = pairs * (n - 2) / (m - 2);
    sets::GraphSize size;
    size.candidates = triples * candidates;
    size.sets = pairs * on_two + triples * on_three;
    size.switches = kSwitchesOfSquaredSets * size.sets * size.sets / (n * n);
    return size.Times(kBytes) + kBytesOfPair * n * n;
  };
  return {"the graph of the planner polygon", polygon.face_count(), "edges", bytes_for};
}

}  // namespace regrasp::polygon
