#include "planner/object/triangle_mesh.h"

#include <Eigen/Geometry>

#include "planner/base/number.h"

namespace regrasp::object {

Eigen::Vector3d DoubleAreaVector(const TriangleMesh& mesh, TriangleIndex triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
}

std::string VertexName(const TriangleMesh& mesh, int vertex) {
  const Eigen::Vector3d& p = mesh.vertices[vertex];
  return "vertex " + std::to_string(mesh.vertex_in_file[vertex]) + " (" + FormatShort(p.x()) +
         ", " + FormatShort(p.y()) + ", " + FormatShort(p.z()) + ")";
}

std::string FacetName(const TriangleMesh& mesh, TriangleIndex triangle) {
  return "facet " + std::to_string(mesh.facet_of_triangle[triangle]);
}

}  // namespace regrasp::object
