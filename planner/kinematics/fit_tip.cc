#include "planner/kinematics/fit_tip.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "planner/grasp/convex_hull.h"
#include "planner/lp/simplex.h"

namespace regrasp::kinematics {
namespace {

using collision::ConvexShape;
using Eigen::Vector3d;
using Eigen::Vector4d;

/// What a ball's radius is worth against how far it is from where it should touch.
constexpr double kLarger = 1;
/// Pulls a ball to one side or the other where it may be anywhere between them.
constexpr double kSideways = 1e-3;
constexpr double kOptimal = 1e-12;
/// A ball smaller than this share of the shape is that of a flat one.
constexpr double kFlat = 1e-3;
/// What of the objective may be missing after the first phase.
constexpr double kUnbalanced = 1e-9;
constexpr int kPivots = 1000;

/// a · c + r ≤ b, as a column of the dual program: minimise Σ b λ over Σ λ (a, 1) = objective.
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

/// (c, r) that maximises objective · (c, r) inside the facets.
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
    throw std::runtime_error("no ball fits into the tip");
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
  // In units of the shape and about its middle: the program's tolerances are absolute.
  const collision::Ball around = collision::BallAround(shape);
  std::vector<Vector3d> points;
  points.reserve(shape.points.size());
  for (const Vector3d& point : shape.points) {
    points.push_back((point - around.centre) / around.radius);
  }
  const std::vector<Facet> facets = FacetsOf(points);
  Vector4d sideways = Vector4d::Zero();
  sideways.head<3>() = kSideways * directions.far.cross(directions.pad);
  // Optima are a convex set: the middle of two is one.
  const Vector4d best =
      (Maximise(objective + sideways, facets) + Maximise(objective - sideways, facets)) / 2;
  if (best[3] < kFlat) throw std::runtime_error("the tip is flat");
  fitted.ball = {around.centre + around.radius * best.head<3>(), around.radius * best[3]};
  const auto short_of = [&](const Vector3d& direction) {
    return farthest(direction) - direction.dot(fitted.ball.centre) - fitted.ball.radius;
  };
  fitted.short_of_far = short_of(directions.far);
  if (has_pad) fitted.short_of_pad = short_of(directions.pad);
  return fitted;
}

}  // namespace regrasp::kinematics
