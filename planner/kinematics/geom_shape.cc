#include "planner/kinematics/geom_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/kinematics/model_names.h"

namespace regrasp::kinematics {
namespace {

using collision::ConvexShape;
using Eigen::Vector3d;

constexpr int kSides = 16;
/// How far a marker may stick out of the fingertip sphere, metres.
constexpr double kInsideFingertip = 5e-4;
constexpr double kPi = std::numbers::pi;

ConvexShape Box(const Vector3d& half) {
  ConvexShape box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                        (corner & 4) != 0 ? 1 : -1);
    box.points.push_back(half.cwiseProduct(sign));
  }
  return box;
}

/// A prism whose sides touch the cylinder.
ConvexShape Cylinder(double radius, double half_length) {
  ConvexShape prism;
  const double corner = radius / std::cos(kPi / kSides);
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * kPi * i / kSides;
    for (const double z : {-half_length, half_length}) {
      prism.points.emplace_back(corner * std::cos(angle), corner * std::sin(angle), z);
    }
  }
  return prism;
}

/// An ellipsoid is a ball in other units: the polyhedron around it is that around a ball,
/// stretched.
ConvexShape Ellipsoid(const Vector3d& half) {
  ConvexShape shape;
  constexpr int kRings = kSides / 2;
  // Every facet between neighbouring points of the unit sphere is nearer to its centre than 1, by
  // no more than this: the angle from its middle to a corner is at most half the diagonal's.
  const double step = kPi / kRings;
  const double grow = 1 / std::cos(step / std::numbers::sqrt2);
  for (int ring = 0; ring <= kRings; ++ring) {
    const double polar = kPi * ring / kRings;
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * kPi * i / kSides;
      const Vector3d on_ball(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                             std::cos(polar));
      shape.points.push_back(grow * half.cwiseProduct(on_ball));
      if (ring == 0 || ring == kRings) break;
    }
  }
  return shape;
}

/// The vertices of the hull where MuJoCo has made one, else all.
ConvexShape MeshHull(const mjModel& model, int mesh) {
  ConvexShape hull;
  const float* vertices = model.mesh_vert + std::ptrdiff_t{3} * model.mesh_vertadr[mesh];
  const auto add = [&](int vertex) {
    hull.points.push_back(
        Eigen::Map<const Eigen::Vector3f>(vertices + std::ptrdiff_t{3} * vertex).cast<double>());
  };
  const int graph = model.mesh_graphadr[mesh];
  if (graph >= 0) {
    // How many vertices and faces the hull has, where the edges of each vertex are, then the
    // numbers of its vertices in the mesh.
    const int count = model.mesh_graph[graph];
    for (int i = 0; i < count; ++i) add(model.mesh_graph[graph + 2 + count + i]);
  } else {
    for (int i = 0; i < model.mesh_vertnum[mesh]; ++i) add(i);
  }
  return hull;
}

}  // namespace

ConvexShape ShapeOfGeom(const mjModel& model, int geom) {
  const mjtNum* size = model.geom_size + std::ptrdiff_t{3} * geom;
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return {{Vector3d::Zero()}, size[0]};
    case mjGEOM_CAPSULE:
      return {{{0, 0, -size[1]}, {0, 0, size[1]}}, size[0]};
    case mjGEOM_BOX:
      return Box({size[0], size[1], size[2]});
    case mjGEOM_CYLINDER:
      return Cylinder(size[0], size[1]);
    case mjGEOM_ELLIPSOID:
      return Ellipsoid({size[0], size[1], size[2]});
    case mjGEOM_MESH:
      return MeshHull(model, model.geom_dataid[geom]);
    default:
      return {};
  }
}

bool IsPartOfFingertip(const mjModel& model, const mjData& rest, int geom, int tip_body,
                       const collision::Ball& sphere) {
  const int body = model.geom_bodyid[geom];
  if (body == tip_body) return true;
  if (LinkOf(model, body) != LinkOf(model, tip_body)) return false;
  const collision::ConvexShape shape = Moved(PoseAt(rest.xpos, rest.xmat, tip_body).inverse() *
                                                 PoseAt(rest.geom_xpos, rest.geom_xmat, geom),
                                             ShapeOfGeom(model, geom));
  const double most = sphere.radius + kInsideFingertip - shape.radius;
  return std::ranges::all_of(shape.points, [&](const Eigen::Vector3d& point) {
    return (point - sphere.centre).norm() <= most;
  });
}

}  // namespace regrasp::kinematics
