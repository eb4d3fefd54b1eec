#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "planner/object/triangle_tree.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// Triangles with a normal and optionally a colour at each corner. Flat triangles have three equal
/// normals.
struct ShadedMesh {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<std::array<Eigen::Vector3d, 3>> normals;
  std::vector<std::array<Color, 3>> colors = {};  ///< empty: one colour for the whole mesh

  void AddFlat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  void Add(const std::array<Eigen::Vector3d, 3>& corners,
           const std::array<Eigen::Vector3d, 3>& corner_normals);
};

/// Return the mesh with the opposite orientation.
[[nodiscard]] ShadedMesh TurnInsideOut(ShadedMesh mesh);

/// The triangles of a mesh by the indices of its different corners.
struct WeldedMesh {
  std::vector<Eigen::Vector3d> vertices;      ///< in the order in which they first occur
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices
};

/// Return a mesh in which triangles share corners of equal coordinates.
[[nodiscard]] WeldedMesh Weld(const ShadedMesh& mesh);

/// Offset a surface. Each corner moves along the mean normal of its triangles, weighted by their
/// angles (Thürmer and Wüthrich 1998), so that the surface has no gaps at creases.
/// @param by  distance, in units of the mesh.
void Grow(double by, ShadedMesh& mesh);

/// Return a slightly enlarged mesh with inward orientation. The mesh hides all of it but the rim,
/// which is an outline of the mesh.
/// @param width  width of the rim, in units of the mesh.
[[nodiscard]] ShadedMesh MakeShell(ShadedMesh mesh, double width);

/// Return a closed cone with its apex at the origin that opens along +z.
/// @param friction_angle  angle between axis and side, radians.
/// @param slant       length of the side.
[[nodiscard]] ShadedMesh MakeCone(double friction_angle, double slant);

/// Return a flat friction cone: a triangle in the plane y = 0 with its apex at the origin that
/// opens along +z, as a thin closed plate at y > 0.
[[nodiscard]] ShadedMesh MakeWedge(double friction_angle, double slant);

/// Return the surface of all points within `radius` of the segment from..to, which may be a point.
[[nodiscard]] ShadedMesh MakeCapsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                     double radius);

/// Return the filled outline of a capsule: a flat band with round ends, perpendicular to the line
/// of sight and at the near side of the capsule.
/// @param back  unit vector towards the eye.
[[nodiscard]] ShadedMesh MakeBand(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                  double radius, const Eigen::Vector3d& back);

/// Triangles of a mesh, for ray queries.
///
/// A ray has an origin and a unit direction. Intersections up to distance `skip` are ignored,
/// because a ray can start on the surface. A ray through an edge hits both triangles. An empty tree
/// has no intersections.
class RayTree {
 public:
  RayTree() = default;
  explicit RayTree(const ShadedMesh& mesh) : tree_(mesh.triangles, kLeafTriangles) {}

  /// Return the distance to the first triangle; infinity if there is none.
  [[nodiscard]] double Distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                double skip) const;
  /// Return the number of triangles that a ray hits, at most `most`.
  [[nodiscard]] int CountHits(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double skip, int most) const;

 private:
  static constexpr int kLeafTriangles = 4;

  object::TriangleTree tree_;
};

/// A surface with a pose.
struct PlacedRays {
  const RayTree* rays;
  Eigen::Isometry3d to_rays;  ///< transformation into the frame of the surface
};

/// Return whether a ray hits one of the surfaces.
[[nodiscard]] bool IsHit(const std::vector<PlacedRays>& surfaces, const Eigen::Vector3d& origin,
                         const Eigen::Vector3d& direction, double skip);

}  // namespace regrasp::render
