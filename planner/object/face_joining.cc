#include "planner/object/face_joining.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "planner/object/object.h"

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

/// Flat element of the file: a polygon, or a triangle of a bent polygon.
struct Facet {
  Vector3d area_vector = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  ///< outward unit normal
  std::vector<int> neighbors;          ///< elements across its edges
  double longest_edge = 0;
  int across_longest = -1;
  bool sliver = false;
  bool filled = false;
};

std::vector<Facet> CollectFacets(const TriangleMesh& mesh, const SurfaceTopology& topology,
                                 double diameter, const std::vector<bool>& filled) {
  std::vector<Facet> facets(mesh.flat_count);
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    Facet& facet = facets[mesh.flat_of_triangle[t]];
    facet.filled = !filled.empty() && filled[mesh.facet_of_triangle[t]];
    facet.area_vector += DoubleAreaVector(mesh, t) / 2;
    for (int k = 0; k < 3; ++k) {
      const int other = mesh.flat_of_triangle[topology.neighbor[t][k]];
      if (other == mesh.flat_of_triangle[t]) continue;
      facet.neighbors.push_back(other);
      const double length =
          (mesh.vertices[mesh.triangles[t][(k + 1) % 3]] - mesh.vertices[mesh.triangles[t][k]])
              .norm();
      if (length > facet.longest_edge) {
        facet.longest_edge = length;
        facet.across_longest = other;
      }
    }
  }
  for (Facet& facet : facets) {
    facet.normal = facet.area_vector.stableNormalized();
    facet.sliver = facet.area_vector.norm() <= kSliverThickness * diameter * facet.longest_edge;
  }
  return facets;
}

/// Return whether the angle is at most kCoplanarAngle. The cosine is too inaccurate near 0.
bool SameDirection(const Vector3d& a, const Vector3d& b) {
  return a.dot(b) > 0 && a.cross(b).norm() <= std::sin(kCoplanarAngle);
}

void Grow(const std::vector<Facet>& facets, int seed, FaceIndex face,
          std::vector<FaceIndex>& face_of) {
  std::vector<int> stack{seed};
  face_of[seed] = face;
  while (!stack.empty()) {
    const int f = stack.back();
    stack.pop_back();
    for (const int next : facets[f].neighbors) {
      if (face_of[next].valid() || facets[next].sliver) continue;
      if (!SameDirection(facets[next].normal, facets[f].normal) ||
          !SameDirection(facets[next].normal, facets[seed].normal) ||
          facets[next].filled != facets[seed].filled) {
        continue;
      }
      face_of[next] = face;
      stack.push_back(next);
    }
  }
}

/// Maximum length of a chain of slivers that is followed.
constexpr int kLongestSliverChain = 64;

/// Follow slivers across their longest edges to an element with a face; invalid if they form a
/// cycle.
FaceIndex FaceBehindSlivers(const std::vector<Facet>& facets, const std::vector<FaceIndex>& face_of,
                            int f) {
  for (int steps = 0; steps < kLongestSliverChain; ++steps) {
    if (face_of[f].valid()) return face_of[f];
    f = facets[f].across_longest;
  }
  return {};
}

std::vector<FaceIndex> JoinFacets(const std::vector<Facet>& facets) {
  std::vector<int> by_area(facets.size());
  std::iota(by_area.begin(), by_area.end(), 0);
  std::ranges::stable_sort(by_area, std::ranges::greater(),
                           [&](int f) { return facets[f].area_vector.norm(); });
  std::vector<FaceIndex> face_of(facets.size());
  FaceIndex next{0};
  for (const int seed : by_area) {
    if (face_of[seed].valid() || facets[seed].sliver) continue;
    Grow(facets, seed, next, face_of);
    ++next;
  }
  for (const int f : by_area) {
    if (face_of[f].valid()) continue;
    face_of[f] = FaceBehindSlivers(facets, face_of, f);
    if (face_of[f].valid()) continue;
    face_of[f] = next;
    ++next;
  }
  return face_of;
}

/// Number faces in the order of their first elements in the file.
void Renumber(std::vector<FaceIndex>& face_of) {
  std::vector<FaceIndex> renumbered(face_of.size());
  int next = 0;
  for (FaceIndex& face : face_of) {
    if (!renumbered[face].valid()) renumbered[face] = FaceIndex(next++);
    face = renumbered[face];
  }
}

}  // namespace

std::vector<FaceIndex> JoinCoplanarFacets(const TriangleMesh& mesh, const SurfaceTopology& topology,
                                          double diameter, const std::vector<bool>& filled) {
  std::vector<FaceIndex> face_of_facet =
      JoinFacets(CollectFacets(mesh, topology, diameter, filled));
  Renumber(face_of_facet);
  std::vector<FaceIndex> face_of_triangle;
  face_of_triangle.reserve(mesh.triangles.size());
  for (const int facet : mesh.flat_of_triangle) face_of_triangle.push_back(face_of_facet[facet]);
  return face_of_triangle;
}

}  // namespace regrasp::object
