#pragma once

#include <array>
#include <string>
#include <vector>

#include "planner/object/object.h"

namespace regrasp {

/// Vertices and facets as a file gives them, unchecked. A facet is a polygon of vertex indices,
/// counter-clockwise from outside.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> facets;
};

/// What makes a soup not the surface of one solid.
enum class MeshDefect {
  kEmpty,             ///< no facet, or no volume
  kNotFinite,         ///< a coordinate is NaN, infinite or beyond 1e15
  kIndexOutOfRange,   ///< a facet names a vertex that is not there
  kDegenerateFacet,   ///< fewer than three different corners, or no area
  kNotPlanar,         ///< a polygon's corners do not lie in one plane
  kNotClosed,         ///< an edge has one facet
  kNotManifold,       ///< an edge has more than two facets, or a vertex joins two fans
  kNotOriented,       ///< neighbouring facets run along their edge the same way
  kSelfIntersecting,  ///< two facets meet elsewhere than at a shared edge or vertex
  kSeveralSolids,     ///< two shells beside each other, or a cavity oriented outward
};

/// A solid bounded by a closed triangle mesh whose coplanar neighbours are joined into faces.
class Polyhedron final : public Object {
 public:
  struct Face {
    Eigen::Vector3d inward_normal;
    Eigen::Vector3d point;  ///< a point of the face's plane, the area centroid
    double area;
    std::vector<int> triangles;  ///< indices into triangles()
    /// Directed border segments (vertex indices), outline and holes, material of the face on the
    /// left seen from outside.
    std::vector<std::array<int, 2>> border;
  };

  /// Checks, orients (a wholly inward mesh is turned) and joins a soup.
  /// @param name  how messages call it, usually the file's path.
  /// @throws InputError  names the facet or vertex (counted from 0) and the MeshDefect.
  static Polyhedron FromSoup(const PolygonSoup& soup, const std::string& name);

  [[nodiscard]] const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  /// Counter-clockwise from outside; polygons of the file are triangulated.
  [[nodiscard]] const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] int face_of_triangle(int triangle) const { return face_of_triangle_[triangle]; }

  [[nodiscard]] int dimension() const override { return 3; }
  [[nodiscard]] int face_count() const override { return static_cast<int>(faces_.size()); }
  [[nodiscard]] Eigen::Vector3d inward_normal(int face) const override;
  [[nodiscard]] double face_measure(int face) const override;
  [[nodiscard]] Eigen::Vector3d ClosestPoint(int face, const Eigen::Vector3d& point) const override;
  [[nodiscard]] std::vector<int> FacesNear(const Eigen::Vector3d& point,
                                           double tolerance) const override;
  [[nodiscard]] double DistanceToBorder(int face, const Eigen::Vector3d& point) const override;
  [[nodiscard]] bool ContainsSegment(int face, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                     double tolerance) const override;

 private:
  Polyhedron(std::vector<Eigen::Vector3d> vertices, std::vector<std::array<int, 3>> triangles,
             std::vector<int> face_of_triangle, std::vector<Face> faces, double diameter,
             MassProperties mass_properties);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<int> face_of_triangle_;
  std::vector<Face> faces_;
};

}  // namespace regrasp
