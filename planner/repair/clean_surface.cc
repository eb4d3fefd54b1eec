#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/object/body_measures.h"
#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

using MeshPoint = Kernel::Point_3;
using Cell = std::array<std::int64_t, 3>;

/// Return for each vertex the first vertex within `distance` that replaces it.
std::vector<int> FindTwins(const std::vector<Eigen::Vector3d>& vertices, double distance) {
  std::map<Cell, std::vector<int>> standing;
  std::vector<int> twin(vertices.size());
  for (int v = 0; v < std::ssize(vertices); ++v) {
    const Eigen::Vector3d& p = vertices[v];
    const auto cell_of = [&](int axis) {
      return static_cast<std::int64_t>(std::floor(p[axis] / distance));
    };
    const Cell cell = {cell_of(0), cell_of(1), cell_of(2)};
    twin[v] = v;
    for (int i = 0; i < 27 && twin[v] == v; ++i) {
      const auto found =
          standing.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (found == standing.end()) continue;
      for (const int other : found->second) {
        if ((vertices[other] - p).norm() <= distance) twin[v] = other;
      }
    }
    if (twin[v] == v) standing[cell].push_back(v);
  }
  return twin;
}

/// Return the corners of a polygon after welding, without consecutive duplicates.
std::vector<int> CornersOf(const std::vector<int>& facet, const std::vector<int>& twin) {
  std::vector<int> corners;
  for (const int v : facet) {
    if (corners.empty() || corners.back() != twin[v]) corners.push_back(twin[v]);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

/// Triangulate a polygon with minimal area.
void AddTriangles(const std::vector<int>& corners, const std::vector<MeshPoint>& points,
                  std::vector<std::vector<std::size_t>>& triangles) {
  if (corners.size() < 3) return;
  std::vector<MeshPoint> outline;
  for (const int v : corners) outline.push_back(points[v]);
  std::vector<CGAL::Triple<int, int, int>> patch = {{0, 1, 2}};
  if (corners.size() > 3) {
    patch.clear();
    pmp::triangulate_hole_polyline(outline, std::back_inserter(patch));
  }
  for (const auto& [a, b, c] : patch) {
    triangles.push_back(
        {std::size_t(corners[a]), std::size_t(corners[b]), std::size_t(corners[c])});
  }
}

object::PolygonSoup ToSoup(const std::vector<MeshPoint>& points,
                           const std::vector<std::vector<std::size_t>>& triangles) {
  object::PolygonSoup soup;
  for (const MeshPoint& p : points) soup.vertices.emplace_back(p.x(), p.y(), p.z());
  for (const auto& t : triangles) soup.facets.push_back({int(t[0]), int(t[1]), int(t[2])});
  return soup;
}

/// Stitch seams and remove degenerate triangles as far as CGAL can.
Mesh Tidied(Mesh mesh) {
  pmp::stitch_borders(mesh);
  pmp::remove_degenerate_faces(mesh);
  mesh.collect_garbage();
  return mesh;
}

}  // namespace

StageResult CleanSurface(const object::PolygonSoup& soup) {
  std::vector<MeshPoint> points;
  for (const auto& v : soup.vertices) points.emplace_back(v.x(), v.y(), v.z());
  const double diameter = object::ComputeDiameter(soup.vertices);
  const std::vector<int> twin = FindTwins(soup.vertices, kWeldDistance * diameter);
  std::vector<std::vector<std::size_t>> triangles;
  int polygons = 0;
  for (const auto& facet : soup.facets) {
    const std::vector<int> corners = CornersOf(facet, twin);
    polygons += corners.size() > 3;
    AddTriangles(corners, points, triangles);
  }
  const std::size_t cut = triangles.size();
  pmp::repair_polygon_soup(points, triangles);
  const std::size_t kept = triangles.size();
  const bool oriented = pmp::orient_polygon_soup(points, triangles);
  if (triangles.empty()) throw std::runtime_error("the area of all triangles is 0");
  StageResult result;
  result.facts["polygons_cut"] = polygons;
  result.facts["facets_dropped"] = cut - kept;
  result.facts["consistently_oriented"] = oriented;
  result.soup = SoupOf(Tidied(MeshOf(ToSoup(points, triangles))));
  return result;
}

namespace {

namespace sms = CGAL::Surface_mesh_simplification;
namespace pmp = CGAL::Polygon_mesh_processing;

/// Largest number of attempts to simplify without new intersections.
constexpr int kMostSimplifications = 12;
/// Number of intersecting pairs beyond which excluding their edges cannot help.
constexpr std::size_t kMostClosePairs = 2000;

using IsKept = Mesh::Property_map<Mesh::Edge_index, bool>;
using Boxes = std::vector<CGAL::Bbox_3>;

enum class Care {
  kAsItComes,
  kNoTurns,  ///< no triangle flips; planar faces are then simplified little
};

/// Collapse edges until at most `facets` triangles remain.
/// @param kept  boxes; edges whose bounding box overlaps one are not collapsed.
Mesh Collapsed(const Mesh& fine, Care care, const Boxes& kept, int facets) {
  Mesh mesh = fine;
  IsKept is_kept = mesh.add_property_map<Mesh::Edge_index, bool>("e:kept", false).first;
  for (const auto edge : mesh.edges()) {
    const CGAL::Bbox_3 box =
        mesh.point(mesh.vertex(edge, 0)).bbox() + mesh.point(mesh.vertex(edge, 1)).bbox();
    is_kept[edge] = std::ranges::any_of(
        kept, [&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(box, other); });
  }
  // A closed surface of triangles has three edges for two triangles.
  const sms::Count_stop_predicate<Mesh> stop(std::size_t(facets) * 3 / 2 + 1);
  const sms::Constrained_placement<sms::LindstromTurk_placement<Mesh>, IsKept> placement(is_kept);
  const auto how = CGAL::parameters::edge_is_constrained_map(is_kept).get_placement(placement);
  if (care == Care::kNoTurns) {
    sms::edge_collapse(mesh, stop, how.filter(sms::Bounded_normal_change_filter<>()));
  } else {
    sms::edge_collapse(mesh, stop, how);
  }
  mesh.collect_garbage();
  return mesh;
}

/// Return the boxes in which non-adjacent triangles intersect: the common part of both bounding
/// boxes.
Boxes MeetingIn(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(faces(mesh), mesh, std::back_inserter(pairs),
                          CGAL::parameters::maximum_number(kMostClosePairs));
  Boxes boxes;
  for (const auto& [one, other] : pairs) {
    const CGAL::Bbox_3 a = pmp::face_bbox(one, mesh);
    const CGAL::Bbox_3 b = pmp::face_bbox(other, mesh);
    boxes.emplace_back(std::max(a.xmin(), b.xmin()), std::max(a.ymin(), b.ymin()),
                       std::max(a.zmin(), b.zmin()), std::min(a.xmax(), b.xmax()),
                       std::min(a.ymax(), b.ymax()), std::min(a.zmax(), b.zmax()));
  }
  return boxes;
}

/// Collapse edges without causing intersections.
/// @returns nullopt if intersections or more than `facets` triangles remain.
std::optional<Mesh> CollapsedApart(const Mesh& fine, Care care, int facets) {
  Boxes kept;
  for (int round = 0; round < kMostSimplifications; ++round) {
    Mesh mesh = Collapsed(fine, care, kept, facets);
    if (std::ssize(mesh.faces()) > facets) return std::nullopt;
    const Boxes meeting = MeetingIn(mesh);
    if (meeting.empty()) return mesh;
    if (meeting.size() == kMostClosePairs) return std::nullopt;
    kept.insert(kept.end(), meeting.begin(), meeting.end());
  }
  return std::nullopt;
}

}  // namespace

StageResult Simplify(const object::PolygonSoup& soup, int facets) {
  const Mesh fine = MeshOf(soup);
  std::optional<Mesh> coarse = CollapsedApart(fine, Care::kAsItComes, facets);
  if (!coarse) coarse = CollapsedApart(fine, Care::kNoTurns, facets);
  // The caller's check reports the intersections.
  if (!coarse) coarse = Collapsed(fine, Care::kAsItComes, {}, facets);
  StageResult result{SoupOf(*coarse)};
  result.facts["facets"] = coarse->num_faces();
  return result;
}

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

/// Share of the largest shell's volume below which a shell is a scrap that folds back on itself.
constexpr double kScrapVolume = 1e-6;

/// Number of listed holes, widest first.
constexpr std::size_t kListedHoles = 20;

struct Hole {
  double length = 0;
  double width = 0;
};

Hole Measure(const Mesh& mesh, Mesh::Halfedge_index border) {
  Hole hole;
  std::vector<Eigen::Vector3d> corners;
  for (const auto h : CGAL::halfedges_around_face(border, mesh)) {
    const auto& p = mesh.point(mesh.target(h));
    corners.emplace_back(p.x(), p.y(), p.z());
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    hole.length += (corners[(i + 1) % corners.size()] - corners[i]).norm();
  }
  hole.width = object::ComputeDiameter(corners);
  return hole;
}

/// Drop closed parts without volume if other parts have volume.
void DropScraps(Mesh& mesh) {
  const std::vector<Mesh> parts = PartsOf(mesh);
  std::vector<double> volumes;
  for (const Mesh& part : parts) volumes.push_back(std::abs(VolumeOf(part)));
  const double least = kScrapVolume * *std::ranges::max_element(volumes);
  Mesh kept;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (volumes[i] >= least) CGAL::copy_face_graph(parts[i], kept);
  }
  mesh = std::move(kept);
}

}  // namespace

StageResult FillHoles(const object::PolygonSoup& soup) {
  Mesh mesh = MeshOf(soup);
  std::vector<Mesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
  std::vector<Hole> holes;
  for (const auto border : borders) {
    holes.push_back(Measure(mesh, border));
    if (!FillHole(mesh, border)) throw std::runtime_error("a hole cannot be filled");
  }
  DropScraps(mesh);
  std::ranges::sort(holes, std::ranges::greater(), &Hole::width);
  StageResult result{SoupOf(mesh)};
  result.facts["holes"] = holes.size();
  Json& widest = result.facts["widest"] = Json::array();
  for (std::size_t i = 0; i < std::min(holes.size(), kListedHoles); ++i) {
    widest.push_back({{"border_length", holes[i].length}, {"width", holes[i].width}});
  }
  return result;
}

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
  if (pairs.size() >= kMostPairs) throw std::runtime_error("too many triangles intersect");
  return pairs;
}

/// Surface with removed triangles. Vertices keep their indices.
class CutOut {
 public:
  explicit CutOut(const Mesh& whole) : whole_(whole) {
    for (const auto& [one, other] : FindPairs(whole)) facets_.insert({one, other});
    if (facets_.empty()) throw std::runtime_error("triangles do not intersect");
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
  throw std::runtime_error("intersecting triangles cannot be separated");
}

}  // namespace regrasp::repair
