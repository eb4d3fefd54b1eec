#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::object {

using TriangleIndex = Index<struct TriangleTag>;

/// Triangles with their places in the file, so that checks can name what they find.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> vertex_in_file;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<int> facet_of_triangle;         ///< the file's facets, counted from 0
  /// What is flat, counted from 0 in the file's order: a facet, or a triangle of a bent one.
  std::vector<int> flat_of_triangle;
  int flat_count = 0;
};

/// Twice the area of a triangle times its unit outward normal.
[[nodiscard]] Eigen::Vector3d DoubleAreaVector(const TriangleMesh& mesh, TriangleIndex triangle);

/// "vertex 3 (0.1, 0, 2.5)", as the file counts.
[[nodiscard]] std::string VertexName(const TriangleMesh& mesh, int vertex);

/// "facet 12", as the file counts.
[[nodiscard]] std::string FacetName(const TriangleMesh& mesh, TriangleIndex triangle);

}  // namespace regrasp::object
