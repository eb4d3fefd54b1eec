#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
namespace pmp = CGAL::Polygon_mesh_processing;

/// Where facets meet less is collapsed; so often at most.
constexpr int kMostSimplifications = 12;
/// Where so many pairs of facets meet it is no matter of some places.
constexpr std::size_t kMostClosePairs = 2000;

using IsKept = Mesh::Property_map<Mesh::Edge_index, bool>;
using Boxes = std::vector<CGAL::Bbox_3>;

enum class Care {
  kAsItComes,
  kNoTurns,  ///< no facet turns over; flat faces are then hardly made coarser
};

/// @param kept  edges that come into one of these stay.
Mesh Collapsed(const Mesh& fine, Care care, const Boxes& kept, int facets) {
  Mesh mesh = fine;
  IsKept is_kept = mesh.add_property_map<Mesh::Edge_index, bool>("e:kept", false).first;
  for (const auto edge : mesh.edges()) {
    const CGAL::Bbox_3 box =
        mesh.point(mesh.vertex(edge, 0)).bbox() + mesh.point(mesh.vertex(edge, 1)).bbox();
    is_kept[edge] = std::ranges::any_of(
        kept, [&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(box, other); });
  }
  // A closed surface of triangles has three edges for two facets.
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

/// Where facets meet that are no neighbours there: what the boxes of both have in common.
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

/// Nullopt where facets meet all the same, or where that takes more facets.
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
  // What is wrong with it is said by who looks at it.
  if (!coarse) coarse = Collapsed(fine, Care::kAsItComes, {}, facets);
  StageResult result{SoupOf(*coarse)};
  result.facts["facets"] = coarse->num_faces();
  return result;
}

}  // namespace regrasp::repair
