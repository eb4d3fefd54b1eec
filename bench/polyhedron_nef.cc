#include "bench/polyhedron_nef.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/convex_hull_3.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace regrasp {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

constexpr int kSides = 8;
constexpr double kHeight = 3;  // in diameters

/// Return the points of a part and the points that see them from one side, up to a height.
Nef MakeHalf(const polyhedron::FacePart& part, const Vector3d& axis, double tangent,
             double height) {
  std::vector<Kernel::Point_3> points;
  const auto add = [&](const Vector3d& p) { points.emplace_back(p.x(), p.y(), p.z()); };
  for (const Vector2d& y : part.outline()) {
    const Vector3d corner = part.origin + y.x() * part.u + y.y() * part.v;
    add(corner);
    for (int side = 0; side < kSides; ++side) {
      const double angle = 2 * std::numbers::pi * (side + 0.5) / kSides;
      const Vector3d aside = std::cos(angle) * part.u + std::sin(angle) * part.v;
      add(corner + height * (axis + tangent * aside));
    }
  }
  CGAL::Polyhedron_3<Kernel> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  return Nef(hull);
}

}  // namespace

struct NefVolumes::Volumes {
  std::map<int, Nef> of_face;
};

NefVolumes::NefVolumes(const object::Polyhedron& solid, const polyhedron::FaceParts& parts,
                       std::span<const int> faces, double tangent)
    : volumes_(std::make_unique<Volumes>()) {
  const double height = kHeight * solid.diameter();
  for (const int face : faces) {
    if (volumes_->of_face.contains(face)) continue;
    const polyhedron::FacePart& part = parts.parts[parts.first[face]];
    volumes_->of_face.emplace(face, MakeHalf(part, part.normal, tangent, height) +
                                        MakeHalf(part, -part.normal, tangent, height));
  }
}

NefVolumes::~NefVolumes() = default;

bool NefVolumes::HasCell(std::span<const FaceIndex, 4> faces) const {
  Nef common = volumes_->of_face.at(faces[0]);
  for (const int face : faces.subspan(1)) common *= volumes_->of_face.at(face);
  return !common.interior().is_empty();
}

}  // namespace regrasp
