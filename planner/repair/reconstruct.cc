#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/alpha_wrap_3.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/object/body_measures.h"
#include "planner/object/facet_triangulation.h"
#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

bool HasOpenEdges(const object::PolygonSoup& soup) {
  std::set<std::pair<int, int>> edges;
  for (const auto& facet : soup.facets) {
    for (std::size_t k = 0; k < facet.size(); ++k) {
      const int from = facet[k], to = facet[(k + 1) % facet.size()];
      if (edges.erase({to, from}) == 0) edges.insert({from, to});
    }
  }
  return !edges.empty();
}

std::vector<int> ShellOfFacets(const object::PolygonSoup& soup) {
  std::vector<int> root(soup.vertices.size());
  for (int v = 0; v < std::ssize(root); ++v) root[v] = v;
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& facet : soup.facets) {
    for (const int v : facet) root[find(v)] = find(facet[0]);
  }
  std::vector<int> number(root.size(), -1);
  std::vector<int> shells;
  int count = 0;
  for (const auto& facet : soup.facets) {
    int& shell = number[find(facet[0])];
    if (shell < 0) shell = count++;
    shells.push_back(shell);
  }
  return shells;
}

int CountShells(const object::PolygonSoup& soup) {
  const std::vector<int> shells = ShellOfFacets(soup);
  return shells.empty() ? 0 : 1 + *std::ranges::max_element(shells);
}

namespace {

using CloudPoint = Kernel::Point_3;
using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

/// Edge length, in typical distances between neighbours, beyond which a triangle bridges an
/// unscanned region.
constexpr double kLongEdge = 8;

/// Smallest number of points of an object.
constexpr std::size_t kFewestPoints = 10;

double MiddleOf(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Return the median distance of a point to its nearest neighbour.
double TypicalDistance(const Search::Tree& tree, const std::vector<CloudPoint>& points) {
  std::vector<double> distances;
  for (const CloudPoint& p : points) {
    Search search(tree, p, 2);  // the first neighbour is the point itself
    distances.push_back(std::sqrt(std::next(search.begin())->second));
  }
  return MiddleOf(std::move(distances));
}

/// Return the spread of a point's neighbours across their plane over their smallest spread in it.
double ScatterAt(const Search::Tree& tree, const CloudPoint& p) {
  constexpr int kNeighbors = 12;
  Search search(tree, p, 1 + kNeighbors);
  Eigen::Matrix3Xd spread(3, std::distance(search.begin(), search.end()));
  Eigen::Index i = 0;
  for (auto found = search.begin(); found != search.end(); ++found, ++i) {
    const auto offset = found->first - p;
    spread.col(i) = Eigen::Vector3d(offset.x(), offset.y(), offset.z());
  }
  spread.colwise() -= spread.rowwise().mean().eval();
  const Eigen::Vector3d widths = spread.jacobiSvd().singularValues();  // in decreasing order
  return widths[1] > 0 ? widths[2] / widths[1] : 0;
}

/// Return the median scatter.
double ScatterOf(const Search::Tree& tree, const std::vector<CloudPoint>& points) {
  /// Largest number of evaluated points; taken at equal steps from the sorted points.
  constexpr std::size_t kSamples = 10000;
  const std::size_t step = 1 + points.size() / kSamples;
  std::vector<double> scatters;
  for (std::size_t i = 0; i < points.size(); i += step) {
    scatters.push_back(ScatterAt(tree, points[i]));
  }
  return MiddleOf(std::move(scatters));
}

/// Return a hash of a point.
std::uint64_t OwnNumber(const CloudPoint& p) {
  std::uint64_t bits = 0;
  for (const double x : {p.x(), p.y(), p.z()}) {  // mixing function of splitmix64
    bits += std::bit_cast<std::uint64_t>(x) + 0x9e3779b97f4a7c15;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
    bits ^= bits >> 31;
  }
  return bits;
}

/// Priority of triangles: the radius, with ties broken by a hash of the points.
/// CGAL breaks ties, which are frequent on grids, by memory address. That depends on the calling
/// program.
struct RadiusOrPoints {
  template <class Front, class Cell>
  double operator()(const Front& front, Cell& cell, const int& index) const {
    constexpr double kTies = 1e-9;
    const double radius = front.smallest_radius_delaunay_sphere(cell, index);
    std::uint64_t own = 0;  // sum over the corners, hence equal from both sides
    for (int k = 1; k < 4; ++k) own += OwnNumber(cell->vertex((index + k) % 4)->point());
    return radius * (1 + kTies * (double(own) * 0x1p-64));
  }
};

/// Orient each shell outwards, and give its triangles a canonical order that starts at the smallest
/// corner.
void MakeCanonical(object::PolygonSoup& soup) {
  const std::vector<int> shells = ShellOfFacets(soup);
  // The reference point must not depend on the order of the vertices, because it determines the
  // sign of an open shell's volume.
  const Eigen::Vector3d middle =
      std::accumulate(soup.vertices.begin(), soup.vertices.end(), Eigen::Vector3d(0, 0, 0)) /
      double(soup.vertices.size());
  std::vector<double> volume(soup.facets.size(), 0);
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    const auto& t = soup.facets[f];
    volume[shells[f]] +=
        (soup.vertices[t[0]] - middle)
            .dot((soup.vertices[t[1]] - middle).cross(soup.vertices[t[2]] - middle));
  }
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    if (volume[shells[f]] < 0) std::ranges::reverse(soup.facets[f]);
  }
  for (auto& t : soup.facets) std::ranges::rotate(t, std::ranges::min_element(t));
  std::ranges::sort(soup.facets);
}

}  // namespace

StageResult ReconstructSurface(const object::PolygonSoup& cloud) {
  std::vector<CloudPoint> points;
  for (const auto& v : cloud.vertices) points.emplace_back(v.x(), v.y(), v.z());
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < kFewestPoints) throw std::runtime_error("expected at least 10 points");
  const Search::Tree tree(points.begin(), points.end());
  const double longest = kLongEdge * TypicalDistance(tree, points);
  std::vector<std::array<std::size_t, 3>> triangles;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                               std::back_inserter(triangles), RadiusOrPoints());
  StageResult result;
  for (const CloudPoint& p : points) result.soup.vertices.emplace_back(p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : triangles) {
    const double edge = std::sqrt(std::max({CGAL::squared_distance(points[a], points[b]),
                                            CGAL::squared_distance(points[b], points[c]),
                                            CGAL::squared_distance(points[c], points[a])}));
    if (edge <= longest) result.soup.facets.push_back({int(a), int(b), int(c)});
  }
  if (result.soup.facets.empty()) throw std::runtime_error("points do not form a surface");
  MakeCanonical(result.soup);
  result.facts["points"] = points.size();
  result.facts["typical_distance"] = longest / kLongEdge;
  result.facts["scatter"] = ScatterOf(tree, points);
  result.facts["triangles_that_bridge"] = triangles.size() - result.soup.facets.size();
  return result;
}

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

using Point = Kernel::Point_3;

/// Radius of the coarse wrap over that of the final wrap. Its volume includes openings that it
/// cannot enter.
constexpr double kCoarser = 4;

/// Largest number of rounds that move vertices of bad triangles back to the wrap.
constexpr int kMaxPasses = 20;

std::vector<Point> PointsOf(const object::PolygonSoup& soup) {
  std::vector<Point> points;
  for (const auto& v : soup.vertices) points.emplace_back(v.x(), v.y(), v.z());
  return points;
}

Mesh Wrap(const object::PolygonSoup& soup, double radius, double offset) {
  Mesh mesh;
  CGAL::alpha_wrap_3(PointsOf(soup), soup.facets, radius, offset, mesh);
  mesh.collect_garbage();
  return mesh;
}

Eigen::Vector3d ToVector(const Point& p) { return {p.x(), p.y(), p.z()}; }

using Faces = std::set<Mesh::Face_index>;

/// Return whether a triangle has no reliable normal.
/// Adjacent slivers do not share a normal either, and a planar face of slivers does not bound a
/// solid.
bool IsSliver(const Point& a, const Point& b, const Point& c, double diameter) {
  if (CGAL::collinear(a, b, c)) return true;
  const double double_area = std::sqrt(CGAL::cross_product(b - a, c - a).squared_length());
  const double longest = std::sqrt(std::max(
      {CGAL::squared_distance(a, b), CGAL::squared_distance(b, c), CGAL::squared_distance(c, a)}));
  return double_area / 2 <= object::kSliverThickness * diameter * longest;
}

/// Return the triangles in `faces` that are slivers, intersect each other or have flipped.
/// @param before  normals before vertices were moved.
Faces FindBad(const Faces& faces, const Mesh& mesh, const std::vector<Kernel::Vector_3>& before,
              double diameter) {
  Faces bad;
  for (const auto f : faces) {
    const auto h = mesh.halfedge(f);
    const Point &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                &c = mesh.point(mesh.target(mesh.next(h)));
    const auto normal = CGAL::cross_product(b - a, c - a);
    if (IsSliver(a, b, c, diameter) || normal * before[f] <= 0) bad.insert(f);
  }
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(faces, mesh, std::back_inserter(pairs));
  for (const auto& [one, other] : pairs) {
    bad.insert(one);
    bad.insert(other);
  }
  return bad;
}

/// Return `faces` widened by rings of neighbours.
Faces Widened(Faces faces, const Mesh& mesh) {
  constexpr int kRings = 4;
  for (int ring = 0; ring < kRings; ++ring) {
    Faces wider = faces;
    for (const auto f : faces) {
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
        for (const auto next : mesh.faces_around_target(mesh.halfedge(v))) wider.insert(next);
      }
    }
    faces = std::move(wider);
  }
  return faces;
}

/// Project the vertices of a wrap onto a surface, unless triangles become bad.
/// @returns number of vertices that stay on the wrap.
int DrawBack(Mesh& mesh, const SurfaceDistance& surface, double diameter) {
  std::vector<Point> wrapped;
  std::vector<Kernel::Vector_3> normals;
  for (const auto v : mesh.vertices()) wrapped.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) normals.push_back(pmp::compute_face_normal(f, mesh));
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d p = surface.ClosestPoint(ToVector(wrapped[v]));
    mesh.point(v) = Point(p.x(), p.y(), p.z());
  }
  const Faces all(mesh.faces().begin(), mesh.faces().end());
  std::set<Mesh::Vertex_index> outside;
  // A vertex that returns to the wrap affects only its neighbourhood. All triangles are checked
  // once no bad one remains.
  Faces examined = all;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const Faces bad = FindBad(examined, mesh, normals, diameter);
    if (bad.empty() && examined.size() == all.size()) return static_cast<int>(outside.size());
    for (const auto f : bad) {
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
        mesh.point(v) = wrapped[v];
        outside.insert(v);
      }
    }
    examined = bad.empty() ? all : Widened(bad, mesh);
  }
  for (const auto v : mesh.vertices()) mesh.point(v) = wrapped[v];
  return static_cast<int>(wrapped.size());
}

}  // namespace

StageResult WrapSurface(const object::PolygonSoup& soup) {
  const double diameter = object::ComputeDiameter(soup.vertices);
  const double radius = kWrapDetail * diameter;
  StageResult result;
  const Mesh coarse = Wrap(soup, kCoarser * radius, kWrapOffset * radius);
  Mesh mesh = Wrap(soup, radius, kWrapOffset * radius);
  result.facts["volumes"] = {{{"radius", kCoarser * radius}, {"volume", VolumeOf(coarse)}},
                             {{"radius", radius}, {"volume", VolumeOf(mesh)}}};
  result.facts["vertices"] = mesh.num_vertices();
  result.facts["vertices_outside"] = DrawBack(mesh, SurfaceDistance(soup), diameter);
  result.soup = SoupOf(mesh);
  return result;
}

StageResult Solidify(const object::PolygonSoup& soup, double thickness) {
  /// Radius of the wrapping sphere over the thickness; it smooths the surface of a sheet.
  constexpr double kBall = 1;
  StageResult result{SoupOf(Wrap(soup, kBall * thickness, thickness / 2))};
  result.facts["thickness"] = thickness;
  return result;
}

}  // namespace regrasp::repair
