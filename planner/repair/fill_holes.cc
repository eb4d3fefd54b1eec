#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/object/diameter.h"
#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

/// Shells of less than this share of the largest's volume are scraps that fold back on themselves.
constexpr double kScrapVolume = 1e-6;

/// At most so many holes are listed, the widest.
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

/// Drops closed parts without volume, if others have one.
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

}  // namespace regrasp::repair
