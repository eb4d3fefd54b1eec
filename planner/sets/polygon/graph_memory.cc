#include "planner/sets/polygon/graph_memory.h"

#include <cmath>
#include <vector>

#include "planner/sets/graph_estimate.h"
#include "planner/sets/polygon/polygon_vertices.h"

namespace regrasp::polygon {

namespace {

/// Counted in a tenth of a second.
constexpr int kCountedEdges = 40;

/// Measured on polygons of 30 to 256 edges at 10° to 30°, as the peak of resident memory: 4 to 12
/// kB a set, most of it the pairs of contacts that it can have; 8 bytes a switch, and two entries
/// in the lists of neighbours. Of the switches 15 to 20 on the same.
constexpr sets::JoinedGraph kMeasured = {
    .bytes = {.candidates = 48, .sets = 7000, .switches = 28}, .common_faces = 2, .switches = 18};

/// Bytes for each pair of edges: the list of the sets on it.
constexpr double kBytesOfPair = 24;

}  // namespace

MemoryNeed EstimatePolygonGraph(const object::Polygon& polygon, double half_angle,
                                planning::Spanning spanning) {
  const double tangent = std::tan(half_angle);  // before the processor rounds upward
  const IntervalScope scope;
  const std::vector<FaceIndex> drawn =
      sets::DrawFaces(polygon, kCountedEdges, RandomStream(0, RandomUse::kCountedEdges));
  const auto counts = FindVertices(EdgeTable(polygon, tangent).Of(drawn), spanning).counts;
  const auto count = [&](GraspType type) { return counts[static_cast<int>(type)]; };
  const GraspTypeCounts concurrent = count(GraspType::kConcurrent);
  const GraspTypeCounts parallel = count(GraspType::kParallel);
  const auto candidates = static_cast<double>(concurrent.candidates + parallel.candidates);
  const auto on_three = static_cast<double>(concurrent.vertices + parallel.vertices);
  const auto on_two = static_cast<double>(count(GraspType::kTwoFinger).vertices);
  const double m = static_cast<double>(drawn.size());
  return sets::NeedOfGraph("polygon", polygon, [=](double n) {
    const double sets = sets::ScaleUp(on_two, 2, m, n) + sets::ScaleUp(on_three, 3, m, n);
    return kMeasured.BytesOf({sets::ScaleUp(candidates, 3, m, n), sets}, n) + kBytesOfPair * n * n;
  });
}

}  // namespace regrasp::polygon
