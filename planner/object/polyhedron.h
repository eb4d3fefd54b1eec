#pragma once

#include <array>
#include <memory>
#include <optional>
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
  /// Checks, orients (a wholly inward mesh is turned) and joins a soup. Vertices with exactly equal
  /// coordinates are one; those that no facet uses are dropped.
  ///
  /// Laws: faces, areas and mass do not depend on how facets are cut or on the order of a facet's
  /// corners' start.
  /// @param name  how messages call it, usually the file's path.
  /// @throws MeshError  (an InputError) with the MeshDefect; names the facet or vertex, from 0, and
  ///                    then counts all that is wrong (SurveyMesh).
  /// @throws TimeUp  the deadline came.
  static Polyhedron FromSoup(const PolygonSoup& soup, const std::string& name,
                             const Reading& reading = {});

  [[nodiscard]] const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  /// Counter-clockwise from outside; polygons of the file are triangulated.
  [[nodiscard]] const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  [[nodiscard]] FaceIndex face_of_triangle(TriangleIndex triangle) const {
    return face_of_triangle_[triangle];
  }
  /// Those of a face, by index.
  [[nodiscard]] const std::vector<TriangleIndex>& TrianglesOf(FaceIndex face) const {
    return triangles_of_face_[face];
  }
  /// The area centroid of a face, a point of its plane.
  [[nodiscard]] Eigen::Vector3d CentroidOf(FaceIndex face) const;

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
  [[nodiscard]] bool IsRough(FaceIndex face, const Eigen::Vector3d& point) const override;

 private:
  static Polyhedron Check(const PolygonSoup& soup, const std::string& name, const Reading& reading);
  Polyhedron(TriangleMesh mesh, std::vector<FaceIndex> face_of_triangle, std::vector<Face> faces,
             double diameter, std::optional<FeltPatch> patch);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<FaceIndex> face_of_triangle_;
  std::vector<std::vector<TriangleIndex>> triangles_of_face_;
  /// Shared between copies: it does not change, and it is as large as the mesh.
  std::shared_ptr<const FaceTree> face_tree_;
  std::optional<FeltPatch> patch_;  ///< with its radius
};

}  // namespace regrasp::object
