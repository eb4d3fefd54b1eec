#include "tests/render/frames/scenes.h"

#include <Eigen/Geometry>
#include <cmath>

#include "planner/base/number.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTipRadius = 0.003;

plan::Snapshot MakeSnapshot(std::vector<plan::FingerState> fingers) {
  plan::Snapshot snapshot;
  snapshot.fingertip_radius_m = kTipRadius;
  snapshot.fingers = std::move(fingers);
  return snapshot;
}

constexpr auto kHolding = plan::FingerRole::kHolding;

}  // namespace

object::Polyhedron MakeThinLBlock() {
  constexpr double a = 0.08;
  constexpr double b = 0.035;
  return object::Polyhedron::FromSoup(
      Extrude({{0, 0}, {a, 0}, {a, b}, {b, b}, {b, a}, {0, a}}, -0.015, 0.015), "l-block");
}

object::Polyhedron MakeHoledBlock() {
  // Outer and inner ring of four vertices. Each side is one quadrilateral, so that no face has a
  // hole.
  const std::vector<Vector2d> outer = {{-0.04, -0.03}, {0.04, -0.03}, {0.04, 0.03}, {-0.04, 0.03}};
  object::PolygonSoup soup = Extrude(outer, -0.015, 0.015);
  soup.facets.resize(4);
  for (const double z : {-0.015, 0.015}) {
    for (const Vector2d& p : outer) soup.vertices.push_back({p.x() * 0.5, p.y() * 0.5, z});
  }
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    soup.facets.push_back({8 + j, 8 + i, 12 + i, 12 + j});
    soup.facets.push_back({j, i, 8 + i, 8 + j});
    soup.facets.push_back({4 + i, 4 + j, 12 + j, 12 + i});
  }
  return object::Polyhedron::FromSoup(soup, "holed block");
}

double Volume(const ShadedMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) volume += a.dot(b.cross(c)) / 6;
  return volume;
}

plan::FingerState MakeFinger(int finger, plan::FingerRole role, const Vector3d& contact,
                             const Vector3d& inward_normal) {
  constexpr double kForce = 2;
  const Vector3d tangent = inward_normal.unitOrthogonal();
  plan::FingerState state;
  state.finger = FingerIndex(finger);
  state.role = role;
  state.contact_W = contact;
  state.normal_W = inward_normal;
  state.tip_W = contact - kTipRadius * inward_normal;
  if (role == plan::FingerRole::kReleased || role == plan::FingerRole::kFree) return state;
  state.force_W = kForce * (std::cos(Radians(8)) * inward_normal + std::sin(Radians(8)) * tangent);
  return state;
}

std::vector<plan::Snapshot> MakeCubeSequence() {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  const plan::FingerState f0 = MakeFinger(0, kHolding, {-0.03, 0.004, 0.010}, x);
  const plan::FingerState f1 = MakeFinger(1, kHolding, {0.005, 0.012, 0.03}, -z);
  const plan::FingerState f2 = MakeFinger(2, kHolding, {0.03, -0.008, 0.005}, -x);
  const plan::FingerState f3 = MakeFinger(3, kHolding, {0.0, -0.005, -0.03}, z);
  plan::FingerState released =
      MakeFinger(0, plan::FingerRole::kReleased, f0.contact_W, f0.normal_W);
  const plan::FingerState placed =
      MakeFinger(4, plan::FingerRole::kPlaced, {0.012, -0.03, -0.004}, y);
  plan::FingerState f4 = placed;
  f4.role = kHolding;
  plan::FingerState moved = MakeFinger(2, plan::FingerRole::kMoved, {0.03, 0.012, -0.012}, -x);
  moved.path_W = {f2.contact_W, moved.contact_W};
  return {MakeSnapshot({f0, f1, f2, f3}), MakeSnapshot({released, f1, f2, f3, placed}),
          MakeSnapshot({f1, moved, f3, f4})};
}

std::vector<plan::Snapshot> MakeLBlockSequence() {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  return {MakeSnapshot({MakeFinger(0, kHolding, {0.042, 0.035, 0.004}, -y),
                        MakeFinger(1, kHolding, {0.035, 0.060, -0.003}, -x),
                        MakeFinger(2, kHolding, {0.050, 0.0, 0.002}, y),
                        MakeFinger(3, kHolding, {0.0, 0.055, 0.0}, x)})};
}

std::vector<plan::Snapshot> MakeHoledBlockSequence() {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  return {MakeSnapshot({MakeFinger(0, kHolding, {0.020, 0.004, 0.0}, x),
                        MakeFinger(1, kHolding, {0.04, 0.002, 0.002}, -x),
                        MakeFinger(2, kHolding, {-0.005, 0.015, 0.003}, y),
                        MakeFinger(3, plan::FingerRole::kPlaced, {-0.008, 0.03, 0.0}, -y),
                        MakeFinger(4, kHolding, {-0.030, -0.01, 0.015}, -z)})};
}

}  // namespace regrasp::render
