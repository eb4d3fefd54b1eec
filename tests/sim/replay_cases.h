#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/object.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/replay/replay.h"
#include "tests/fixtures/models.h"

namespace regrasp::sim {

/// Return the contact at `p` on the face with the inward normal `n`.
/// It has no face if there is none.
inline grasp::Contact ContactAt(const object::Object& object, const Eigen::Vector3d& p,
                                const Eigen::Vector3d& n) {
  grasp::Contact contact{p, n.normalized(), {}};
  for (const FaceIndex face : object.FacesNear(p, object::kPointTolerance * object.diameter())) {
    if ((object.inward_normal(face) - contact.n).norm() < 1e-6) contact.face = face;
  }
  return contact;
}

inline plan::Plan MakePlan(plan::FingerGrasp initial, double friction_angle_deg, int fingers = 5) {
  plan::Plan plan;
  plan.friction_angle = Radians(friction_angle_deg);
  plan.fingers = fingers;
  plan.initial = std::move(initial);
  return plan;
}

/// Draw a contact uniformly over the surface.
inline grasp::Contact DrawContact(const object::Polyhedron& body, std::mt19937& random) {
  const auto corners = [&](std::size_t t) {
    const auto& [a, b, c] = body.triangles()[t];
    return std::array{body.vertices()[a], body.vertices()[b], body.vertices()[c]};
  };
  std::vector<double> areas;
  for (std::size_t t = 0; t < body.triangles().size(); ++t) {
    const auto [a, b, c] = corners(t);
    areas.push_back((b - a).cross(c - a).norm());
  }
  std::discrete_distribution<std::size_t> triangle(areas.begin(), areas.end());
  std::uniform_real_distribution<double> unit(0, 1);
  const std::size_t t = triangle(random);
  const auto [a, b, c] = corners(t);
  const double s = std::sqrt(unit(random)), v = unit(random);
  const FaceIndex face = body.face_of_triangle(object::TriangleIndex(t));
  return {(1 - s) * a + s * (1 - v) * b + s * v * c, body.inward_normal(face), face};
}

/// The cube of models/cube.obj with a grasp about its middle, and grasps near it.
struct CubeCase {
  object::ObjectFile file = ReadModel("cube.obj");
  const object::Object& object = *file.object;

  [[nodiscard]] plan::FingerContact At(int finger, double x, double y, double z) const {
    const Eigen::Vector3d p(x, y, z);
    Eigen::Index axis = 0;
    p.cwiseAbs().maxCoeff(&axis);
    return {FingerIndex(finger),
            ContactAt(object, p, -std::copysign(1.0, p[axis]) * Eigen::Vector3d::Unit(axis))};
  }
  [[nodiscard]] plan::FingerGrasp Start() const {
    return {At(0, 0.03, 0.004, 0.002), At(1, -0.03, 0.002, -0.004), At(2, 0.003, 0.03, 0.004),
            At(3, -0.002, -0.03, 0.001)};
  }
};

}  // namespace regrasp::sim
