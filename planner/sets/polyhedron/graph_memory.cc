#include "planner/sets/polyhedron/graph_memory.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/random.h"
#include "planner/sets/graph_size.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

namespace {

/// Counted in some hundredths of a second.
constexpr int kCountedFaces = 60;

/// Measured on bodies of 24 to 67 faces, as the peak of resident memory: a cell with its pieces and
/// its triples; a switch with its two entries in the lists of neighbours.
constexpr sets::GraphSize kBytes = {.candidates = 60, .sets = 840, .switches = 25};

/// Cells of a candidate: 0.5 to 1.1 on the same bodies.
constexpr double kCellsOfCandidate = 0.75;

/// Switches times the third power of the faces over the square of the cells: 75 to 150 on the same.
constexpr double kSwitchesOfSquaredCells = 100;

}  // namespace

MemoryNeed EstimatePolyhedronGraph(const object::Polyhedron& solid, double half_angle,
                                   planning::Spanning spanning) {
  RandomStream random(0, RandomUse::kCountedFaces);
  std::vector<Eigen::Vector3d> normals;
  for (const int face :
       random.Choose(solid.face_count(), std::min(solid.face_count(), kCountedFaces))) {
    normals.push_back(solid.inward_normal(FaceIndex(face)));
  }
  const auto counted = FindQuadrupleCandidates(normals, std::tan(half_angle), spanning).size();
  const double m = static_cast<double>(normals.size());
  const auto bytes_for = [counted, m](double n) {
    sets::GraphSize size;
    size.candidates = static_cast<double>(counted);
    for (int k = 0; k < 4; ++k) size.candidates *= (n - k) / (m - k);
    size.sets = kCellsOfCandidate * size.candidates;
    size.switches = kSwitchesOfSquaredCells * size.sets * size.sets / (n * n * n);
    // For each pair of faces two rows of bits, one for each face; and a byte for each pair of their
    // halves.
    return size.Times(kBytes) + n * n * n / 4 + 4 * n * n;
  };
  return {"the graph of the planner polyhedron", solid.face_count(), "faces", bytes_for};
}

}  // namespace regrasp::polyhedron
