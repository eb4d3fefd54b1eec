#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

using Face = Mesh::Face_index;
using Pairs = std::vector<std::pair<Face, Face>>;

/// Largest number of rounds. Each widens the gaps whose filling intersects the surface by a ring of
/// triangles.
constexpr int kMostRounds = 12;

/// Largest share of removed triangles. If more intersect, whole solids pass through each other.
constexpr double kMostCutOut = 0.1;

/// Components separated by a gap are dropped if they have at most kScrapFacets triangles and at
/// most 1/kScrapShare of all triangles.
constexpr std::size_t kScrapFacets = 20;
constexpr std::size_t kScrapShare = 100;

Pairs FindPairs(const Mesh& mesh) {
  /// Number of pairs beyond which shells pass through each other, so that local removal cannot
  /// help.
  constexpr std::size_t kMostPairs = 20000;
  Pairs pairs;
  pmp::self_intersections(faces(mesh), mesh, std::back_inserter(pairs),
                          CGAL::parameters::maximum_number(kMostPairs));
  if (pairs.size() >= kMostPairs) throw std::runtime_error("too many facets meet each other");
  return pairs;
}

/// Surface with removed triangles. Vertices keep their indices.
class CutOut {
 public:
  explicit CutOut(const Mesh& whole) : whole_(whole) {
    for (const auto& [one, other] : FindPairs(whole)) facets_.insert({one, other});
    if (facets_.empty()) throw std::runtime_error("no two facets meet");
  }

  [[nodiscard]] std::size_t size() const { return facets_.size(); }
  [[nodiscard]] bool is_too_large() const {
    return double(facets_.size()) > kMostCutOut * double(whole_.num_faces());
  }

  /// Return the surface with filled gaps. The filling can intersect the surface.
  /// @returns nullopt if a gap cannot be filled.
  [[nodiscard]] std::optional<Mesh> Filled() const {
    Mesh mesh = whole_;
    for (const Face f : facets_) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
    pmp::keep_large_connected_components(
        mesh, 1 + std::min(kScrapFacets, faces(mesh).size() / kScrapShare));
    pmp::duplicate_non_manifold_vertices(mesh);
    std::vector<Mesh::Halfedge_index> borders;
    pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
    for (const auto border : borders) {
      if (!FillHole(mesh, border)) return std::nullopt;
    }
    if (mesh.num_faces() == 0) return std::nullopt;
    return mesh;
  }

  /// Also remove all triangles that share a corner with an intersecting pair of a filled surface,
  /// or with any removed triangle.
  void Widen(const Mesh& filled, const Pairs& meeting) {
    std::set<Mesh::Vertex_index> corners;
    for (const auto& [one, other] : meeting) {
      for (const Face f : {one, other}) {
        for (const auto v : filled.vertices_around_face(filled.halfedge(f))) corners.insert(v);
      }
    }
    WidenAbout(corners);
  }
  void Widen() {
    std::set<Mesh::Vertex_index> corners;
    for (const Face f : facets_) {
      for (const auto v : whole_.vertices_around_face(whole_.halfedge(f))) corners.insert(v);
    }
    WidenAbout(corners);
  }

 private:
  void WidenAbout(const std::set<Mesh::Vertex_index>& corners) {
    for (const auto v : corners) {
      if (std::size_t(v) >= whole_.num_vertices()) continue;  // duplicated where parts touch
      for (const Face f : whole_.faces_around_target(whole_.halfedge(v))) facets_.insert(f);
    }
  }

  const Mesh& whole_;
  std::set<Face> facets_;
};

}  // namespace

StageResult RemoveCrossings(const object::PolygonSoup& soup) {
  const Mesh whole = MeshOf(soup);
  if (!CGAL::is_closed(whole)) throw std::runtime_error("not closed");
  CutOut cut(whole);
  const std::size_t crossing = cut.size();
  for (int round = 0; round < kMostRounds && !cut.is_too_large(); ++round) {
    std::optional<Mesh> mesh = cut.Filled();
    const Pairs meeting = mesh ? FindPairs(*mesh) : Pairs();
    if (mesh && meeting.empty()) {
      mesh->collect_garbage();
      StageResult result{SoupOf(*mesh)};
      result.facts["crossing_facets"] = crossing;
      result.facts["facets_cut_out"] = cut.size();
      return result;
    }
    if (mesh) {
      cut.Widen(*mesh, meeting);
    } else {
      cut.Widen();
    }
  }
  throw std::runtime_error("not all facets that meet each other can be parted");
}

}  // namespace regrasp::repair
