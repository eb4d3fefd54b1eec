#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "planner/object/mesh_defect.h"
#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/reading.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

class FaceTree;

/// A solid bounded by a closed triangle mesh whose coplanar neighbours are joined into faces.
class Polyhedron final : public Object {
 public:
  struct Face {
    Eigen::Vector3d inward_normal;
    Eigen::Vector3d point;  ///< a point of the face's plane, the area centroid
    double area;
    std::vector<TriangleIndex> triangles;
    /// Directed border segments (vertex indices), outline and holes, material of the face on the
    /// left seen from outside.
    std::vector<std::array<int, 2>> border;
    std::vector<FaceIndex> beyond;  ///< by border segment: the face across it
    bool enclosed = false;          ///< of a cavity
  };

  /// Checks, orients (a wholly inward mesh is turned) and joins a soup. Vertices with exactly equal
  /// coordinates are one; those that no facet uses are dropped.
  ///
  /// Laws: faces, areas and mass do not depend on how facets are cut or on the order of a facet's
  /// corners' start.
  /// @param name  how messages call it, usually the file's path.
  /// @throws MeshError  (an InputError) with the MeshDefect; names the facet or vertex, from 0.
  /// @throws TimeUp  the deadline came.
  static Polyhedron FromSoup(const PolygonSoup& soup, const std::string& name,
                             const Reading& reading = {});

  [[nodiscard]] const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  /// Counter-clockwise from outside; polygons of the file are triangulated.
  [[nodiscard]] const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] FaceIndex face_of_triangle(TriangleIndex triangle) const {
    return face_of_triangle_[triangle];
  }

  [[nodiscard]] int dimension() const override { return 3; }
  [[nodiscard]] int face_count() const override { return static_cast<int>(faces_.size()); }
  [[nodiscard]] Eigen::Vector3d inward_normal(FaceIndex face) const override;
  [[nodiscard]] double face_measure(FaceIndex face) const override;
  [[nodiscard]] Eigen::Vector3d ClosestPoint(FaceIndex face,
                                             const Eigen::Vector3d& point) const override;
  [[nodiscard]] std::vector<FaceIndex> FacesNear(const Eigen::Vector3d& point,
                                                 double tolerance) const override;
  [[nodiscard]] std::vector<FaceIndex> FacesNearSegment(const Eigen::Vector3d& a,
                                                        const Eigen::Vector3d& b,
                                                        double tolerance) const override;
  [[nodiscard]] double DistanceToBorder(FaceIndex face,
                                        const Eigen::Vector3d& point) const override;
  [[nodiscard]] bool ContainsSegment(FaceIndex face, const Eigen::Vector3d& a,
                                     const Eigen::Vector3d& b, double tolerance) const override;
  [[nodiscard]] std::vector<FaceBorder> BordersOf(FaceIndex face) const override;
  [[nodiscard]] bool AreNeighbours(FaceIndex face, FaceIndex other) const override;
  [[nodiscard]] std::vector<Eigen::Vector3d> CommonPoints(FaceIndex face, FaceIndex other,
                                                          const Eigen::Vector3d& point,
                                                          double tolerance) const override;
  [[nodiscard]] bool IsEnclosed(FaceIndex face) const override { return faces_[face].enclosed; }

 private:
  Polyhedron(std::vector<Eigen::Vector3d> vertices, std::vector<std::array<int, 3>> triangles,
             std::vector<FaceIndex> face_of_triangle, std::vector<Face> faces, double diameter,
             MassProperties mass_properties);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<FaceIndex> face_of_triangle_;
  std::vector<Face> faces_;
  /// Shared between copies: it does not change, and it is as large as the mesh.
  std::shared_ptr<const FaceTree> face_tree_;
};

}  // namespace regrasp::object
