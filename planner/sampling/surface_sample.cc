#include "planner/sampling/surface_sample.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace regrasp {

SurfaceSampler::SurfaceSampler(const Polyhedron& solid) : solid_(solid) {
  double sum = 0;
  for (int i = 0; i < static_cast<int>(solid.triangles().size()); ++i) {
    if (!solid.IsEnclosed(solid.face_of_triangle(i))) sum += TriangleArea(solid, i);
    area_up_to_.push_back(sum);
  }
}

int SurfaceSampler::DrawTriangle(RandomStream& random) const {
  const double area = random.Uniform() * area_up_to_.back();
  const auto above = std::upper_bound(area_up_to_.begin(), area_up_to_.end(), area);
  const auto last = std::lower_bound(area_up_to_.begin(), area_up_to_.end(), area_up_to_.back());
  return static_cast<int>(std::min(above, last) - area_up_to_.begin());
}

Contact SurfaceSampler::Draw(RandomStream& random) const {
  const int triangle = DrawTriangle(random);
  const auto& [a, b, c] = solid_.triangles()[triangle];
  const double root = std::sqrt(random.Uniform());
  const double along = random.Uniform();
  const Eigen::Vector3d p = (1 - root) * solid_.vertices()[a] +
                            root * (1 - along) * solid_.vertices()[b] +
                            root * along * solid_.vertices()[c];
  return ContactOnTriangle(solid_, triangle, p);
}

double TriangleArea(const Polyhedron& solid, int triangle) {
  const auto& [a, b, c] = solid.triangles()[triangle];
  const Eigen::Vector3d ab = solid.vertices()[b] - solid.vertices()[a];
  const Eigen::Vector3d ac = solid.vertices()[c] - solid.vertices()[a];
  return ab.cross(ac).norm() / 2;
}

Contact ContactOnTriangle(const Polyhedron& solid, int triangle, const Eigen::Vector3d& p) {
  const int face = solid.face_of_triangle(triangle);
  return {solid.ClosestPoint(face, p), solid.inward_normal(face), face};
}

}  // namespace regrasp
