#include "planner/kinematics/fit_tip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "planner/grasp/growing_hull.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/lp/simplex.h"

namespace regrasp::kinematics {

namespace {

using collision::ConvexShape;
using Eigen::Vector3d;

constexpr int kSides = 16;
/// Largest protrusion of a marker from the fingertip sphere, metres.
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

/// Return a prism that contains the cylinder; its sides touch it.
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

/// Return a polyhedron that contains an ellipsoid: a polyhedron around the unit sphere, scaled
/// along the axes.
ConvexShape Ellipsoid(const Vector3d& half) {
  ConvexShape shape;
  constexpr int kRings = kSides / 2;
  // The triangles between neighbouring points of the unit sphere are nearer to its centre than 1.
  // This factor compensates for it: the angle from the middle of a triangle to a corner is at most
  // half that of the diagonal.
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

/// Return the vertices of the convex hull if MuJoCo has computed it, otherwise all vertices.
ConvexShape MeshHull(const mjModel& model, int mesh) {
  ConvexShape hull;
  const float* vertices = model.mesh_vert + std::ptrdiff_t{3} * model.mesh_vertadr[mesh];
  const auto add = [&](int vertex) {
    hull.points.push_back(
        Eigen::Map<const Eigen::Vector3f>(vertices + std::ptrdiff_t{3} * vertex).cast<double>());
  };
  const int graph = model.mesh_graphadr[mesh];
  if (graph >= 0) {
    // Layout: number of vertices, number of faces, start of the edges of each vertex, index of each
    // vertex in the mesh.
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
                       const collision::BoundingSphere& sphere) {
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

namespace {

using Eigen::Vector4d;

/// Weight of a sphere's radius relative to its distance from the required contact points.
constexpr double kLarger = 1;
/// Weight that selects an end of an interval of optimal spheres.
constexpr double kSideways = 1e-3;
constexpr double kOptimal = 1e-12;
/// Radius over that of the bounding sphere below which the shape is flat.
constexpr double kFlat = 1e-3;
/// Largest residual of the first phase.
constexpr double kUnbalanced = 1e-9;
constexpr int kPivots = 1000;

/// Constraint a · c + r ≤ b, a column of the dual program: minimize Σ b λ subject to Σ λ (a, 1) =
/// objective.
struct Facet {
  Vector4d row = Vector4d::Zero();
  double offset = 0;

  template <class Visit>
  void ForEachEntry(const Visit& visit) const {
    for (int i = 0; i < 4; ++i) visit(i, row[i]);
  }
  double cost() const { return offset; }
};

std::vector<Facet> FacetsOf(const std::vector<Vector3d>& points) {
  Eigen::MatrixXd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = points[i];
  }
  std::vector<Facet> facets;
  for (const grasp::HullFacet& facet : grasp::ComputeConvexHull(columns).facets) {
    facets.push_back({{facet.normal[0], facet.normal[1], facet.normal[2], 1}, facet.offset});
  }
  return facets;
}

/// Return (c, r) that maximizes objective · (c, r) subject to the constraints of all faces.
Vector4d Maximise(const Vector4d& objective, const std::vector<Facet>& facets) {
  lp::Simplex<4, Facet> program;
  const auto price = [&](bool with_cost) {
    return [&facets, with_cost](const Vector4d& dual, Facet& column) {
      double best = kOptimal;
      for (const Facet& facet : facets) {
        const double reduced = dual.dot(facet.row) - (with_cost ? facet.offset : 0);
        if (reduced <= best) continue;
        best = reduced;
        column = facet;
      }
      return best > kOptimal;
    };
  };
  const lp::Limits limits{.pivots = kPivots, .refactor_after = 50};
  program.StartFeasibility(objective);
  (void)program.Run(price(false), limits);
  const bool is_bounded = program.unbalanced() < kUnbalanced;
  program.StartOptimality();
  if (!is_bounded || program.Run(price(true), limits) != lp::End::kNoColumn) {
    throw std::runtime_error("no sphere fits into the fingertip");
  }
  return program.dual();
}

}  // namespace

FittedBall FitTip(const ConvexShape& shape, const TipDirections& directions) {
  const auto farthest = [&](const Vector3d& direction) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3d& point : shape.points) most = std::max(most, direction.dot(point));
    return most + shape.radius;
  };
  FittedBall fitted;
  if (shape.radius > 0) {
    const auto end = std::ranges::max_element(
        shape.points, {}, [&](const Vector3d& point) { return directions.far.dot(point); });
    fitted.ball = {*end, shape.radius};
    return fitted;
  }
  const bool has_pad = !directions.pad.isZero();
  Vector4d objective;
  objective << directions.far + directions.pad, (has_pad ? 2 : 1) + kLarger;
  // The program's tolerances are absolute; therefore the shape is centred and scaled to unit size.
  const collision::BoundingSphere around = collision::BoundingSphereOf(shape);
  std::vector<Vector3d> points;
  points.reserve(shape.points.size());
  for (const Vector3d& point : shape.points) {
    points.push_back((point - around.centre) / around.radius);
  }
  const std::vector<Facet> facets = FacetsOf(points);
  Vector4d sideways = Vector4d::Zero();
  sideways.head<3>() = kSideways * directions.far.cross(directions.pad);
  // The optima are a convex set, so the midpoint of two optima is an optimum.
  const Vector4d best =
      (Maximise(objective + sideways, facets) + Maximise(objective - sideways, facets)) / 2;
  if (best[3] < kFlat) throw std::runtime_error("the fingertip is flat");
  fitted.ball = {around.centre + around.radius * best.head<3>(), around.radius * best[3]};
  const auto short_of = [&](const Vector3d& direction) {
    return farthest(direction) - direction.dot(fitted.ball.centre) - fitted.ball.radius;
  };
  fitted.short_of_far = short_of(directions.far);
  if (has_pad) fitted.short_of_pad = short_of(directions.pad);
  return fitted;
}

}  // namespace regrasp::kinematics
