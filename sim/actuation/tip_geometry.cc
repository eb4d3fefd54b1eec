#include "sim/actuation/tip_geometry.h"

#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>
#include <set>

#include "planner/base/error.h"
#include "planner/kinematics/geom_shape.h"
#include "planner/kinematics/model_names.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/hand/hand_finding.h"

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;

Eigen::Isometry3d PoseInBody(const mjModel& model, int geom) {
  mjtNum matrix[9];
  mju_quat2Mat(matrix, model.geom_quat + std::ptrdiff_t{4} * geom);
  return kinematics::PoseAt(model.geom_pos + std::ptrdiff_t{3} * geom, matrix, 0);
}

/// Directions for the points of tips that touch the object: what the hull of all points reaches
/// beyond those found is less than a thousandth of its size.
constexpr int kManyDirections = 2000;
/// Directions for shapes that are checked for collisions: less than half a hundredth.
constexpr int kSomeDirections = 500;

/// The points that are farthest in some direction, of `directions` that are spread evenly.
std::vector<Vector3d> Outermost(const std::vector<Vector3d>& points, int directions) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::set<std::size_t> kept;
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2.0 * i + 1) / directions;
    const double r = std::sqrt(1 - z * z);
    const Vector3d direction(r * std::cos(golden * i), r * std::sin(golden * i), z);
    std::size_t best = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      if (points[k].dot(direction) > points[best].dot(direction)) best = k;
    }
    kept.insert(best);
  }
  std::vector<Vector3d> outermost;
  for (const std::size_t k : kept) outermost.push_back(points[k]);
  return outermost;
}

std::vector<collision::ConvexShape> ShapesOf(const mjModel& model, const std::string& link,
                                             int directions) {
  const int body = mj_name2id(&model, mjOBJ_BODY, link.c_str());
  std::vector<collision::ConvexShape> shapes;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.geom_bodyid[geom] != body || !kinematics::Collides(model, geom)) continue;
    collision::ConvexShape shape =
        collision::Moved(PoseInBody(model, geom), kinematics::ShapeOfGeom(model, geom));
    if (shape.points.empty()) continue;
    shape.points = Outermost(shape.points, directions);
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

TipShapes GeometryOf(const mjModel& model, const std::string& link) {
  TipShapes shapes = ShapesOf(model, link, kManyDirections);
  for (collision::ConvexShape& shape : shapes) {
    if (shape.radius == 0) shape.radius = kTipSkin;
  }
  return shapes;
}

}  // namespace

std::vector<collision::ConvexShape> CollisionShapesOf(const mjModel& model,
                                                      const std::string& body) {
  return ShapesOf(model, body, kSomeDirections);
}

std::vector<TipShapes> TipShapesOf(const kinematics::HandFile& file, TipShape tip) {
  std::vector<TipShapes> tips;
  for (FingerIndex finger{0}; finger < std::ssize(file.hand.fingers); ++finger) {
    const auto& ball = file.description.tips[finger];
    if (tip == TipShape::kBall) {
      tips.push_back({{{ball.centre}, ball.radius}});
      continue;
    }
    tips.push_back(GeometryOf(*file.compiled->model, ball.body));
    if (!tips.back().empty()) continue;
    throw InputError(file.description.model + ": the tip link " + ball.body + " of " +
                     FingerText(file.hand, finger) +
                     " has no collision geometry that could touch the object");
  }
  return tips;
}

}  // namespace regrasp::sim
