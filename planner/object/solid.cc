#include "planner/object/solid.h"

#include <CGAL/Side_of_triangle_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "planner/object/mesh_defect.h"
#include "planner/object/surface_mesh.h"

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

/// A volume below this times area times extent is lost in the rounding of its own sum: 64 units in
/// the last place, as the sum's terms are triangle areas times distances.
constexpr double kVolumeRounding = 64 * 2.3e-16;

struct Shell {
  std::vector<std::array<int, 3>> triangles;
  TriangleIndex first_triangle;  ///< by which messages call it
  double volume = 0;
  double area = 0;
  CGAL::Bbox_3 box;
};

std::vector<Shell> CollectShells(const TriangleMesh& mesh, const SurfaceTopology& topology) {
  std::vector<Shell> shells(topology.shell_count);
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    Shell& shell = shells[topology.shell[t]];
    if (!shell.first_triangle.valid()) shell.first_triangle = t;
    shell.triangles.push_back(mesh.triangles[t]);
    const Vector3d& from = mesh.vertices[mesh.triangles[shell.first_triangle][0]];
    const Vector3d area = DoubleAreaVector(mesh, t) / 2;
    shell.volume += area.dot(mesh.vertices[mesh.triangles[t][0]] - from) / 3;
    shell.area += area.norm();
    for (const int v : mesh.triangles[t]) {
      const Vector3d& p = mesh.vertices[v];
      shell.box += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
  }
  return shells;
}

double Extent(const CGAL::Bbox_3& box) {
  return std::max({box.x_span(), box.y_span(), box.z_span()});
}

void Turn(TriangleMesh& mesh, SurfaceTopology& topology) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  // Edges 0→1, 1→2, 2→0 have become 1→0, 2→1, 0→2 and start at corners 2, 1, 0.
  for (auto& neighbor : topology.neighbor) std::swap(neighbor[0], neighbor[2]);
}

/// Says of points whether they are inside a shell. Shells do not touch, so one vertex of another
/// shell decides for all of it.
class Inside {
 public:
  Inside(const TriangleMesh& mesh, const Shell& shell)
      : mesh_(mesh), box_(shell.box), surface_(MakeSurfaceMesh(mesh, shell.triangles)) {
    side_ = std::make_unique<Side>(surface_);
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  [[nodiscard]] bool Contains(const Shell& other) const {
    if (!CGAL::do_overlap(box_, other.box)) return false;
    const Vector3d& p = mesh_.vertices[other.triangles[0][0]];
    return (*side_)(SurfaceKernel::Point_3(p.x(), p.y(), p.z())) == CGAL::ON_BOUNDED_SIDE;
  }

 private:
  using Side = CGAL::Side_of_triangle_mesh<SurfaceMesh, SurfaceKernel>;
  const TriangleMesh& mesh_;
  CGAL::Bbox_3 box_;
  SurfaceMesh surface_;
  std::unique_ptr<Side> side_;
};

[[noreturn]] void RejectShell(const TriangleMesh& mesh, const Shell& shell, const std::string& why,
                              const std::string& name) {
  throw MeshError(MeshDefect::kSeveralSolids, name + ": " + FacetName(mesh, shell.first_triangle) +
                                                  ": several solids: its shell " + why);
}

void CheckCavities(const TriangleMesh& mesh, const std::vector<Shell>& shells, std::size_t outside,
                   double orientation, const std::string& name) {
  const Inside in_outside(mesh, shells[outside]);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (s == outside) continue;
    if (!in_outside.Contains(shells[s])) {
      RejectShell(mesh, shells[s], "lies beside another", name);
    }
    if (orientation * shells[s].volume >= 0) {
      RejectShell(mesh, shells[s], "lies inside another and is not oriented as a cavity", name);
    }
  }
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (s == outside) continue;
    const Inside in_cavity(mesh, shells[s]);
    for (std::size_t other = 0; other < shells.size(); ++other) {
      if (other == outside || other == s || !in_cavity.Contains(shells[other])) continue;
      RejectShell(mesh, shells[other], "lies inside a cavity", name);
    }
  }
}

}  // namespace

int OrientSolid(TriangleMesh& mesh, SurfaceTopology& topology, const std::string& name) {
  const std::vector<Shell> shells = CollectShells(mesh, topology);
  const auto largest = std::ranges::max_element(
      shells, {}, [](const Shell& shell) { return std::abs(shell.volume); });
  if (std::abs(largest->volume) <= kVolumeRounding * largest->area * Extent(largest->box)) {
    throw MeshError(MeshDefect::kEmpty, name + ": empty: the surface encloses no volume");
  }
  const double orientation = largest->volume > 0 ? 1 : -1;
  const auto outside = largest - shells.begin();
  if (shells.size() > 1) {
    CheckCavities(mesh, shells, static_cast<std::size_t>(outside), orientation, name);
  }
  if (orientation < 0) Turn(mesh, topology);
  return static_cast<int>(outside);
}

}  // namespace regrasp::object
