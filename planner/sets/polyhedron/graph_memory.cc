#include "planner/sets/polyhedron/graph_memory.h"

#include <cmath>
#include <vector>

#include "planner/sets/graph_estimate.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

namespace {

/// Counted in some hundredths of a second.
constexpr int kCountedFaces = 60;

/// Measured on bodies of 24 to 67 faces, as the peak of resident memory: a cell with its pieces and
/// its triples; a switch with its two entries in the lists of neighbours. Of the switches 75 to 150
/// on the same.
constexpr sets::JoinedGraph kMeasured = {
    .bytes = {.candidates = 60, .sets = 840, .switches = 25}, .common_faces = 3, .switches = 100};

/// Cells of a candidate: 0.5 to 1.1 on the same bodies.
constexpr double kCellsOfCandidate = 0.75;

}  // namespace

MemoryNeed EstimatePolyhedronGraph(const object::Polyhedron& solid, double half_angle,
                                   planning::Spanning spanning) {
  std::vector<Eigen::Vector3d> normals;
  for (const FaceIndex face :
       sets::DrawFaces(solid, kCountedFaces, RandomStream(0, RandomUse::kCountedFaces))) {
    normals.push_back(solid.inward_normal(face));
  }
  const auto counted =
      static_cast<double>(FindQuadrupleCandidates(normals, std::tan(half_angle), spanning).size());
  const double m = static_cast<double>(normals.size());
  return sets::NeedOfGraph("polyhedron", solid, [=](double n) {
    const double candidates = sets::ScaleUp(counted, 4, m, n);
    // For each pair of faces two rows of bits, one for each face; and a byte for each pair of their
    // halves.
    return kMeasured.BytesOf({candidates, kCellsOfCandidate * candidates}, n) + n * n * n / 4 +
           4 * n * n;
  });
}

}  // namespace regrasp::polyhedron
