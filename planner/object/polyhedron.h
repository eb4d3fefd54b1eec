#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

class FaceTree;

/// A solid bounded by a closed triangle mesh with adjacent coplanar triangles joined to faces.
class Polyhedron final : public Object {
 public:
  /// Make a solid from a soup, which is checked, oriented and joined to faces.
  ///
  /// A mesh that is oriented inward is reversed. Vertices with exactly equal coordinates are
  /// merged; unused ones are dropped. Law: faces, areas and mass depend neither on the
  /// triangulation nor on the first corner of each polygon.
  /// @param name  name for messages, usually the file's path.
  /// @throws MeshError  (an InputError) with the MeshDefect if the soup does not bound a solid;
  ///     names the polygon or vertex, from 0, and then counts all defects (SurveyMesh).
  /// @throws TimeUp  if the deadline is reached.
  static Polyhedron FromSoup(const PolygonSoup& soup, const std::string& name,
                             const Reading& reading = {});

  [[nodiscard]] const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  /// Triangles, counter-clockwise from outside; polygons of the file are triangulated.
  [[nodiscard]] const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  [[nodiscard]] FaceIndex face_of_triangle(TriangleIndex triangle) const {
    return face_of_triangle_[triangle];
  }
  /// Triangles of a face, sorted by index.
  [[nodiscard]] const std::vector<TriangleIndex>& TrianglesOf(FaceIndex face) const {
    return triangles_of_face_[face];
  }
  /// Compute the area centroid of a face, a point of its plane.
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
  /// Shared by copies, because it is immutable and as large as the mesh.
  std::shared_ptr<const FaceTree> face_tree_;
  std::optional<FeltPatch> patch_;  ///< radius is set
};

class Polyhedron;

/// Compute the normal that a fingertip feels on its contact patch.
///
/// It is the unit mean, weighted by area, of the surface's inward normals inside a ball about a
/// point. Only surface that is connected with the point inside the ball counts, so the far side of
/// a wall does not.
///
/// Let δ be the angle between the face's normal and this one. A friction cone about the face's
/// normal, narrowed by δ, is inside the cone about this normal. A grasp that is force closure with
/// the narrower cones is therefore force closure with the others.
///
/// Laws: independent of rigid motion, of the unit of length and of the triangulation; equal to the
/// face's normal if the whole patch is on the face.
/// @param face  face on which the point is.
/// @param radius  radius of the ball in units of the solid, > 0.
[[nodiscard]] Eigen::Vector3d PatchNormal(const Polyhedron& solid, FaceIndex face,
                                          const Eigen::Vector3d& point, double radius);

}  // namespace regrasp::object
