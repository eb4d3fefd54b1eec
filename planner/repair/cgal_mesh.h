#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "planner/object/polygon_soup.h"
#include "planner/object/solid.h"

namespace regrasp::repair {

using Kernel = object::SurfaceKernel;
using Mesh = object::SurfaceMesh;

/// Convert a surface of triangles to a CGAL mesh. For .cc files only.
/// @throws std::runtime_error  if more than two triangles share an edge, or two of them have the
///     same direction along it.
[[nodiscard]] Mesh MeshOf(const object::PolygonSoup& soup);

/// Return the triangles of a mesh, in its order.
[[nodiscard]] object::PolygonSoup SoupOf(const Mesh& mesh);

/// Split a mesh into its connected components, in the order of their first triangles.
[[nodiscard]] std::vector<Mesh> PartsOf(const Mesh& mesh);

/// Fill a hole with triangles.
/// @returns false if that is not possible. A long border fails if the Delaunay triangulation of its
///     vertices does not contain a filling, because a search of all triangles takes cubic time.
[[nodiscard]] bool FillHole(Mesh& mesh, Mesh::Halfedge_index border);

/// Return the enclosed volume of a mesh.
/// @pre `mesh` is closed.
[[nodiscard]] double VolumeOf(const Mesh& mesh);

/// Return true iff all vertices of `inner` are inside `outer`.
/// @pre `outer` is closed.
[[nodiscard]] bool IsInside(const Mesh& inner, const Mesh& outer);

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_3;

/// Round an exact point to doubles, such that equal points give equal bits. For .cc files only.
/// CGAL::to_double of a lazily evaluated coordinate depends on earlier evaluations.
[[nodiscard]] inline Eigen::Vector3d Rounded(const ExactPoint& point) {
  const auto& exact = CGAL::exact(point);
  return {CGAL::to_double(exact.x()), CGAL::to_double(exact.y()), CGAL::to_double(exact.z())};
}

/// Distance of points to a set of triangles, and ray casts against them.
class SurfaceDistance {
 public:
  /// @param triangles  surface of triangles; degenerate ones are ignored.
  /// @throws std::runtime_error  if all are degenerate.
  explicit SurfaceDistance(const object::PolygonSoup& triangles);
  ~SurfaceDistance();
  SurfaceDistance(SurfaceDistance&&) noexcept;

  struct Closest {
    Eigen::Vector3d point;
    int facet;
    int triangle;  ///< index of the triangle in the tree, a hint for the next search
  };
  /// Find the point of the surface nearest to `point`.
  /// @param near  result for a nearby point, optional. The closer that point, the faster the
  ///     search.
  [[nodiscard]] Closest FindClosest(const Eigen::Vector3d& point,
                                    const std::optional<Closest>& near = std::nullopt) const;
  /// Return the distance to the triangle found for another point.
  [[nodiscard]] double DistanceTo(const Eigen::Vector3d& point, const Closest& found) const;
  [[nodiscard]] Eigen::Vector3d ClosestPoint(const Eigen::Vector3d& point) const {
    return FindClosest(point).point;
  }
  [[nodiscard]] double DistanceTo(const Eigen::Vector3d& point) const {
    return (ClosestPoint(point) - point).norm();
  }
  /// Return true iff a ray from `point` hits a triangle.
  [[nodiscard]] bool IsHit(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;
  /// Return the distance of the first hit along a ray; infinity if there is none.
  /// @param direction  unit vector.
  [[nodiscard]] double FirstHit(const Eigen::Vector3d& point,
                                const Eigen::Vector3d& direction) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace regrasp::repair
