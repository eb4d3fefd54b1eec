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

/// A polygon of the file, as its triangles make it up.
struct Facet {
  Vector3d area_vector = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  ///< unit, outward
  std::vector<int> neighbors;          ///< facets across its edges
  double longest_edge = 0;
  int across_longest = -1;
  bool sliver = false;
};

std::vector<Facet> CollectFacets(const TriangleMesh& mesh, const SurfaceTopology& topology,
                                 double diameter) {
  std::vector<Facet> facets(mesh.facet_count);
  for (int t = 0; t < std::ssize(mesh.triangles); ++t) {
    Facet& facet = facets[mesh.facet_of_triangle[t]];
    facet.area_vector += DoubleAreaVector(mesh, t) / 2;
    for (int k = 0; k < 3; ++k) {
      const int other = mesh.facet_of_triangle[topology.neighbor[t][k]];
      if (other == mesh.facet_of_triangle[t]) continue;
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

/// By the cross product: near 0 the cosine has lost the angle.
bool SameDirection(const Vector3d& a, const Vector3d& b) {
  return a.dot(b) > 0 && a.cross(b).norm() <= std::sin(kCoplanarAngle);
}

void Grow(const std::vector<Facet>& facets, int seed, int face, std::vector<int>& face_of) {
  std::vector<int> stack{seed};
  face_of[seed] = face;
  while (!stack.empty()) {
    const int f = stack.back();
    stack.pop_back();
    for (const int next : facets[f].neighbors) {
      if (face_of[next] >= 0 || facets[next].sliver) continue;
      if (!SameDirection(facets[next].normal, facets[f].normal) ||
          !SameDirection(facets[next].normal, facets[seed].normal)) {
        continue;
      }
      face_of[next] = face;
      stack.push_back(next);
    }
  }
}

/// Chains of slivers are followed no further than this.
constexpr int kLongestSliverChain = 64;

/// Follows slivers across their longest edges until a facet with a face; −1 where there is none,
/// as slivers can run in a circle.
int FaceBehindSlivers(const std::vector<Facet>& facets, const std::vector<int>& face_of, int f) {
  for (int steps = 0; steps < kLongestSliverChain; ++steps) {
    if (face_of[f] >= 0) return face_of[f];
    f = facets[f].across_longest;
  }
  return -1;
}

std::vector<int> JoinFacets(const std::vector<Facet>& facets) {
  std::vector<int> by_area(facets.size());
  std::iota(by_area.begin(), by_area.end(), 0);
  std::ranges::stable_sort(by_area, std::ranges::greater(),
                           [&](int f) { return facets[f].area_vector.norm(); });
  std::vector<int> face_of(facets.size(), -1);
  int faces = 0;
  for (const int seed : by_area) {
    if (face_of[seed] < 0 && !facets[seed].sliver) Grow(facets, seed, faces++, face_of);
  }
  for (const int f : by_area) {
    if (face_of[f] >= 0) continue;
    const int behind = FaceBehindSlivers(facets, face_of, f);
    face_of[f] = behind >= 0 ? behind : faces++;
  }
  return face_of;
}

/// Counts faces in the order in which the file first meets them.
void Renumber(std::vector<int>& face_of) {
  std::vector<int> renumbered(face_of.size(), -1);
  int next = 0;
  for (int& face : face_of) {
    if (renumbered[face] < 0) renumbered[face] = next++;
    face = renumbered[face];
  }
}

}  // namespace

std::vector<int> JoinCoplanarFacets(const TriangleMesh& mesh, const SurfaceTopology& topology,
                                    double diameter) {
  std::vector<int> face_of_facet = JoinFacets(CollectFacets(mesh, topology, diameter));
  Renumber(face_of_facet);
  std::vector<int> face_of_triangle;
  face_of_triangle.reserve(mesh.triangles.size());
  for (const int facet : mesh.facet_of_triangle) face_of_triangle.push_back(face_of_facet[facet]);
  return face_of_triangle;
}

}  // namespace regrasp::object
