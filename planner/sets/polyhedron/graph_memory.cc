#include "planner/sets/polyhedron/graph_memory.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/random.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

namespace {

/// Counted in some hundredths of a second.
constexpr int kCountedFaces = 60;

// Measured on bodies of 24 to 67 faces, as the peak of resident memory: a candidate and the room
// that a vector keeps to grow into; a cell, its pieces and its triples; a link with its two entries
// in the lists of neighbours.
constexpr double kBytesOfCandidate = 60;
constexpr double kBytesOfCell = 840;
constexpr double kBytesOfLink = 25;

/// Cells of a candidate: 0.5 to 1.1 on the same bodies.
constexpr double kCellsOfCandidate = 0.75;

/// Links times the third power of the faces over the square of the cells: 75 to 150 on the same.
constexpr double kLinksOfSquaredCells = 100;

std::vector<Eigen::Vector3d> DrawNormals(const object::Polyhedron& solid) {
  const int count = solid.face_count();
  RandomStream random(0, RandomUse::kCountedFaces);
  std::vector<Eigen::Vector3d> normals;
  for (const int face : random.Choose(count, std::min(count, kCountedFaces))) {
    normals.push_back(solid.inward_normal(FaceIndex(face)));
  }
  return normals;
}

}  // namespace

MemoryNeed EstimatePolyhedronGraph(const object::Polyhedron& solid, double half_angle,
                                   planning::Spanning spanning) {
  const std::vector<Eigen::Vector3d> normals = DrawNormals(solid);
  const auto counted = FindQuadrupleCandidates(normals, std::tan(half_angle), spanning).size();
  const double m = static_cast<double>(normals.size());
  const auto bytes_for = [counted, m](double n) {
    double candidates = static_cast<double>(counted);
    for (int k = 0; k < 4; ++k) candidates *= (n - k) / (m - k);
    const double cells = kCellsOfCandidate * candidates;
    const double links = kLinksOfSquaredCells * cells * cells / (n * n * n);
    // For each pair of faces two rows of bits, one for each face; and a byte for each pair of their
    // halves.
    const double tables = n * n * n / 4 + 4 * n * n;
    return kBytesOfCandidate * candidates + kBytesOfCell * cells + kBytesOfLink * links + tables;
  };
  return {"the graph of the planner polyhedron", solid.face_count(), "faces", bytes_for};
}

}  // namespace regrasp::polyhedron
