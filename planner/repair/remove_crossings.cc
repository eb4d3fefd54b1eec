#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

using Pairs = std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>>;

/// Gaps are made wider by a ring of facets until what fills them meets nothing; so often at most.
constexpr int kMostRings = 4;

/// No more than this share of the facets is cut out: where more meet, bodies pass through each
/// other.
constexpr double kMostCutOut = 0.1;

/// What is cut off by a gap is dropped where it has no more facets than this, nor more than a
/// hundredth of all.
constexpr std::size_t kScrapFacets = 20;
constexpr std::size_t kScrapShare = 100;

Pairs FindPairs(const Mesh& mesh) {
  /// More than this many pairs are no blemishes: shells that pass through each other.
  constexpr std::size_t kMostPairs = 20000;
  Pairs pairs;
  pmp::self_intersections(faces(mesh), mesh, std::back_inserter(pairs),
                          CGAL::parameters::maximum_number(kMostPairs));
  if (pairs.size() >= kMostPairs) throw std::runtime_error("too many facets meet each other");
  return pairs;
}

/// The facets of the pairs, and so many rings about them.
std::set<Mesh::Face_index> FacetsAbout(const Pairs& pairs, int rings, const Mesh& mesh) {
  std::set<Mesh::Face_index> about;
  for (const auto& [one, other] : pairs) about.insert({one, other});
  for (int ring = 0; ring < rings; ++ring) {
    for (const auto f : std::set(about)) {
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
        for (const auto next : mesh.faces_around_target(mesh.halfedge(v))) {
          if (next != Mesh::null_face()) about.insert(next);
        }
      }
    }
  }
  return about;
}

/// Cuts facets out and fills the gaps. @returns whether they could be filled.
bool Refill(Mesh& mesh, const std::set<Mesh::Face_index>& facets) {
  for (const auto f : facets) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  pmp::keep_large_connected_components(
      mesh, 1 + std::min(kScrapFacets, faces(mesh).size() / kScrapShare));
  pmp::duplicate_non_manifold_vertices(mesh);
  std::vector<Mesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
  for (const auto border : borders) {
    std::vector<Mesh::Face_index> patch;
    pmp::triangulate_hole(mesh, border, std::back_inserter(patch));
    if (patch.empty()) return false;
  }
  mesh.collect_garbage();
  return mesh.num_faces() > 0 && !pmp::does_self_intersect(mesh);
}

}  // namespace

StageResult RemoveCrossings(const object::PolygonSoup& soup) {
  const Mesh whole = MeshOf(soup);
  if (!CGAL::is_closed(whole)) throw std::runtime_error("it is not closed");
  const Pairs pairs = FindPairs(whole);
  if (pairs.empty()) throw std::runtime_error("no two facets meet");
  for (int rings = 0; rings <= kMostRings; ++rings) {
    Mesh mesh = whole;
    const std::set<Mesh::Face_index> facets = FacetsAbout(pairs, rings, mesh);
    if (double(facets.size()) > kMostCutOut * double(mesh.num_faces())) break;
    if (!Refill(mesh, facets)) continue;
    StageResult result{SoupOf(mesh)};
    result.facts["crossing_pairs"] = pairs.size();
    result.facts["rings_cut_out"] = rings;
    return result;
  }
  Mesh mesh = whole;
  if (!pmp::experimental::remove_self_intersections(mesh,
                                                    CGAL::parameters::preserve_genus(false))) {
    throw std::runtime_error("not all facets that meet each other can be parted");
  }
  mesh.collect_garbage();
  StageResult result{SoupOf(mesh)};
  result.facts["crossing_pairs"] = pairs.size();
  return result;
}

}  // namespace regrasp::repair
