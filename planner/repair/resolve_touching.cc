#include "planner/repair/resolve_touching.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/object/body_measures.h"
#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

using Eigen::Vector3d;

namespace {

/// Length below which the sum of two unit normals has no direction.
constexpr double kFlat = 1e-6;

/// Side of a triangle, from its k-th corner to the next.
struct Side {
  int facet;
  int k;
  bool operator<(const Side& other) const {
    return std::pair(facet, k) < std::pair(other.facet, other.k);
  }
};

/// Two sides at one edge, of triangles that are adjacent in a fan.
using Sides = std::pair<Side, Side>;

class Resolver {
 public:
  Resolver(const object::PolygonSoup& soup, Touching touching)
      : soup_(soup),
        joins_(touching == Touching::kJoin),
        by_(kTouchingMoved * object::ComputeDiameter(soup.vertices)) {}

  object::PolygonSoup Resolve() {
    PairSides();
    NumberRings();
    object::PolygonSoup resolved;
    resolved.vertices = std::move(vertices_);
    for (int f = 0; f < std::ssize(soup_.facets); ++f) AddFacet(f, resolved);
    return resolved;
  }

 private:
  [[nodiscard]] int Corner(const Side& side) const { return soup_.facets[side.facet][side.k % 3]; }
  [[nodiscard]] const Vector3d& At(const Side& side) const { return soup_.vertices[Corner(side)]; }
  [[nodiscard]] static Side Next(const Side& side) { return {side.facet, (side.k + 1) % 3}; }
  [[nodiscard]] Vector3d NormalOf(int facet) const {
    const Vector3d& a = At({facet, 0});
    return (At({facet, 1}) - a).cross(At({facet, 2}) - a).stableNormalized();
  }

  void PairSides() {
    std::map<std::pair<int, int>, std::vector<Side>> at_edge;
    for (int f = 0; f < std::ssize(soup_.facets); ++f) {
      for (int k = 0; k < 3; ++k) {
        const Side side{f, k};
        at_edge[std::minmax(Corner(side), Corner(Next(side)))].push_back(side);
      }
    }
    for (auto& [edge, sides] : at_edge) {
      if (sides.size() == 2) {
        pairs_.emplace_back(sides[0], sides[1]);
      } else {
        PairAbout(edge, sides);
      }
    }
  }

  /// Pair the triangles about an edge with more than two of them.
  /// Inside and outside alternate about the edge. The triangles of a pair enclose inside if parts
  /// are separated, and outside if parts are joined. Each pair gets a new vertex at the middle of
  /// the edge, moved into the enclosed region.
  void PairAbout(const std::pair<int, int>& edge, std::vector<Side>& sides) {
    const Vector3d& from = soup_.vertices[edge.first];
    const Vector3d along = (soup_.vertices[edge.second] - from).normalized();
    const Vector3d u = along.unitOrthogonal(), v = along.cross(u);
    const auto angle = [&](const Side& side) {
      const Vector3d apex = At(Next(Next(side))) - from;
      return std::atan2(apex.dot(v), apex.dot(u));
    };
    std::ranges::sort(sides, {}, angle);
    // The region counter-clockwise of a triangle that runs against the edge is inside.
    const auto has_inside_next = [&](const Side& side) { return Corner(side) == edge.second; };
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Side& one = sides[i];
      const Side& other = sides[(i + 1) % sides.size()];
      if (has_inside_next(one) == has_inside_next(other)) {
        throw std::runtime_error("cannot determine the interior");
      }
      if (has_inside_next(one) == joins_) continue;
      pairs_.emplace_back(one, other);
      touching_.insert({edge.first, edge.second});
      Vector3d between = (joins_ ? 1 : -1) * (NormalOf(one.facet) + NormalOf(other.facet));
      if (between.norm() < kFlat) between = At(Next(Next(one))) - from;  // a slit or a blade
      middle_of_[one] = middle_of_[other] =
          static_cast<int>(soup_.vertices.size() + middles_.size());
      middles_.push_back((from + soup_.vertices[edge.second]) / 2 + by_ * between.normalized());
    }
  }

  /// Give each fan of triangles about a vertex a vertex of its own.
  /// The only fan of a vertex keeps its position.
  void NumberRings() {
    std::vector<int> root(3 * soup_.facets.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    const auto place = [](const Side& side) { return 3 * side.facet + side.k; };
    for (const auto& [one, other] : pairs_) {  // their directions along the edge are opposite
      root[find(place(one))] = find(place(Next(other)));
      root[find(place(Next(one)))] = find(place(other));
    }
    std::vector<std::vector<int>> rings(soup_.vertices.size());
    for (int i = 0; i < std::ssize(root); ++i) {
      if (find(i) == i) rings[Corner({i / 3, i % 3})].push_back(i);
    }
    std::vector<Vector3d> outwards(root.size(), Vector3d::Zero());
    for (int i = 0; i < std::ssize(root); ++i) outwards[find(i)] += NormalOf(i / 3);
    vertices_ = soup_.vertices;
    vertices_.insert(vertices_.end(), middles_.begin(), middles_.end());
    std::vector<int> number(root.size(), -1);
    for (std::size_t v = 0; v < rings.size(); ++v) {
      for (const int ring : rings[v]) {
        number[ring] = static_cast<int>(v);
        if (rings[v].size() == 1) continue;
        number[ring] = static_cast<int>(vertices_.size());
        const double by = joins_ && touching_.contains(static_cast<int>(v)) ? by_ : -by_;
        vertices_.push_back(soup_.vertices[v] + by * outwards[ring].stableNormalized());
      }
    }
    for (int i = 0; i < std::ssize(root); ++i) vertex_of_.push_back(number[find(i)]);
  }

  /// Add a triangle, split at the new vertices in the middle of its sides.
  void AddFacet(int facet, object::PolygonSoup& resolved) const {
    std::vector<int> outline;
    std::size_t fan = 0;  // a middle vertex, from which the whole outline is visible
    for (int k = 0; k < 3; ++k) {
      outline.push_back(vertex_of_[3 * facet + k]);
      const auto middle = middle_of_.find({facet, k});
      if (middle == middle_of_.end()) continue;
      fan = outline.size();
      outline.push_back(middle->second);
    }
    const std::size_t n = outline.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      resolved.facets.push_back({outline[fan], outline[(fan + i) % n], outline[(fan + i + 1) % n]});
    }
  }

  const object::PolygonSoup& soup_;
  bool joins_;
  double by_;
  std::vector<Sides> pairs_;
  std::vector<Vector3d> middles_;
  std::set<int> touching_;  ///< end vertices of edges with more than two triangles
  /// New middle vertex by side, at edges with more than two triangles.
  std::map<Side, int> middle_of_;
  std::vector<Vector3d> vertices_;
  std::vector<int> vertex_of_;  ///< new vertex by triangle corner
};

}  // namespace

object::PolygonSoup ResolveTouching(const object::PolygonSoup& soup, Touching touching) {
  return Resolver(soup, touching).Resolve();
}

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

/// Exact coordinates are required because a chain of unions in rounded coordinates would intersect
/// at earlier cuts.
using ExactMesh = CGAL::Surface_mesh<ExactPoint>;

struct Shell {
  Mesh mesh;
  double volume = 0;
  CGAL::Bbox_3 box;
};

/// Return the shells, largest first and oriented outwards. Cavities, that is inward shells inside
/// another shell, are kept.
std::vector<Shell> ShellsOf(const Mesh& mesh) {
  std::vector<Shell> shells;
  for (Mesh& part : PartsOf(mesh)) {
    if (!CGAL::is_closed(part)) throw std::runtime_error("not all shells are closed");
    if (pmp::does_self_intersect(part)) throw std::runtime_error("a shell intersects itself");
    const double volume = VolumeOf(part);
    const CGAL::Bbox_3 box = pmp::bbox(part);
    shells.push_back({std::move(part), volume, box});
  }
  std::ranges::stable_sort(shells, std::ranges::greater(),
                           [](const Shell& shell) { return std::abs(shell.volume); });
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (shells[i].volume >= 0) continue;
    const bool cavity =
        std::any_of(shells.begin(), shells.begin() + std::ptrdiff_t(i), [&](const Shell& o) {
          return CGAL::do_overlap(shells[i].box, o.box) && IsInside(shells[i].mesh, o.mesh);
        });
    if (cavity) continue;
    pmp::reverse_face_orientations(shells[i].mesh);
    shells[i].volume = -shells[i].volume;
  }
  return shells;
}

ExactMesh Exact(const Mesh& mesh) {
  ExactMesh exact;
  CGAL::copy_face_graph(mesh, exact);
  return exact;
}

Mesh RoundedMesh(const ExactMesh& exact) {
  Mesh mesh;
  std::vector<std::pair<ExactMesh::Vertex_index, Mesh::Vertex_index>> copies;
  CGAL::copy_face_graph(
      exact, mesh, CGAL::parameters::vertex_to_vertex_output_iterator(std::back_inserter(copies)));
  for (const auto& [from, to] : copies) {
    const Eigen::Vector3d p = Rounded(exact.point(from));
    mesh.point(to) = Kernel::Point_3(p.x(), p.y(), p.z());
  }
  return mesh;
}

void Add(ExactMesh& body, const Shell& shell) {
  ExactMesh other = Exact(shell.mesh);
  const bool solid = shell.volume >= 0;
  if (!solid) pmp::reverse_face_orientations(other);
  ExactMesh sum;
  const bool done = solid ? pmp::corefine_and_compute_union(body, other, sum)
                          : pmp::corefine_and_compute_difference(body, other, sum);
  if (!done) throw std::runtime_error("shells cannot be united");
  body = std::move(sum);
}

}  // namespace

StageResult UniteShells(const object::PolygonSoup& soup) {
  const std::vector<Shell> shells = ShellsOf(MeshOf(soup));
  ExactMesh body = Exact(shells[0].mesh);
  for (std::size_t i = 1; i < shells.size(); ++i) Add(body, shells[i]);
  StageResult result{SoupOf(RoundedMesh(body))};
  result.facts["shells"] = shells.size();
  result.facts["cavities"] =
      std::ranges::count_if(shells, [](const Shell& shell) { return shell.volume < 0; });
  return result;
}

}  // namespace regrasp::repair
