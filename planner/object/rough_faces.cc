#include "planner/object/rough_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

Vector3d CentreOf(const TriangleMesh& mesh, TriangleIndex t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
}

/// Adds up the area vectors about a face.
class PatchSum {
 public:
  PatchSum(const TriangleMesh& mesh, const SurfaceTopology& topology, double radius)
      : mesh_(mesh),
        topology_(topology),
        radius_(radius),
        most_area_(std::numbers::pi * radius * radius),
        seen_by_(mesh.triangles.size(), -1) {}

  /// @param own  the face's triangles.
  Vector3d About(int face, const std::vector<TriangleIndex>& own) {
    Vector3d centre = Vector3d::Zero();
    double area = 0;
    for (const TriangleIndex t : own) {
      const double weight = DoubleAreaVector(mesh_, t).norm();
      centre += weight * CentreOf(mesh_, t);
      area += weight;
      seen_by_[t] = face;
    }
    if (area > 0) centre /= area;
    std::vector<TriangleIndex> stack = own;
    Vector3d sum = Vector3d::Zero();
    while (!stack.empty()) {
      const TriangleIndex t = stack.back();
      stack.pop_back();
      sum += Weighed(DoubleAreaVector(mesh_, t) / 2);
      for (const TriangleIndex next : topology_.neighbor[t]) {
        if (seen_by_[next] == face || (CentreOf(mesh_, next) - centre).norm() > radius_) continue;
        seen_by_[next] = face;
        stack.push_back(next);
      }
    }
    return sum;
  }

 private:
  [[nodiscard]] Vector3d Weighed(const Vector3d& area_vector) const {
    const double area = area_vector.norm();
    return area > most_area_ ? Vector3d(area_vector * (most_area_ / area)) : area_vector;
  }

  const TriangleMesh& mesh_;
  const SurfaceTopology& topology_;
  double radius_;
  double most_area_;
  std::vector<int> seen_by_;  ///< of each triangle the face that last met it
};

}  // namespace

std::vector<bool> FindRoughFaces(const TriangleMesh& mesh, const SurfaceTopology& topology,
                                 const std::vector<FaceIndex>& face_of_triangle,
                                 const std::vector<Face>& faces, double radius, double most_angle) {
  std::vector<std::vector<TriangleIndex>> triangles_of(faces.size());
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    triangles_of[face_of_triangle[t]].push_back(t);
  }
  PatchSum patch(mesh, topology, radius);
  std::vector<bool> rough;
  for (FaceIndex face{0}; face < std::ssize(faces); ++face) {
    const Vector3d mean = -patch.About(face, triangles_of[face]);
    const Vector3d& normal = faces[face].inward_normal;
    const double angle = std::atan2(normal.cross(mean).norm(), normal.dot(mean));
    rough.push_back(faces[face].measure < std::numbers::pi * radius * radius && angle > most_angle);
  }
  return rough;
}

}  // namespace regrasp::object
