#include "tests/planner/sets/polyhedron/cone_program.h"

#include <glpk.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace regrasp::polyhedron {

using Eigen::Vector3d;

namespace {

/// Number of sides of the deciding pyramids. Inscribed and circumscribed angles differ by less than
/// 1 %.
constexpr int kSides = 24;

/// Margin below which the solver's rounding decides, divided by the object's size.
constexpr double kLeastMargin = 1e-6;

/// Reach of inscribed pyramids. If they have a common point, the planner must find it. If the
/// planner finds none within its reach of 100, there is none much closer.
constexpr double kInscribedReach = 50;
constexpr double kCircumscribedReach = 200;

class Program {
 public:
  Program() : problem_(glp_create_prob(), &glp_delete_prob) {
    glp_set_obj_dir(problem_.get(), GLP_MAX);
  }

  int AddRow(double value) {
    const int row = glp_add_rows(problem_.get(), 1);
    glp_set_row_bnds(problem_.get(), row, GLP_FX, value, value);
    return row;
  }

  int AddColumn(int type, double least, double most) {
    const int column = glp_add_cols(problem_.get(), 1);
    glp_set_col_bnds(problem_.get(), column, type, least, most);
    return column;
  }

  void Set(int row, int column, double value) {
    if (value == 0) return;
    rows_.push_back(row);
    columns_.push_back(column);
    values_.push_back(value);
  }

  void Set(int first_row, int column, const Vector3d& values) {
    for (int axis = 0; axis < 3; ++axis) Set(first_row + axis, column, values[axis]);
  }

  double Maximise(int column) {
    glp_load_matrix(problem_.get(), static_cast<int>(values_.size()) - 1, rows_.data(),
                    columns_.data(), values_.data());
    glp_set_obj_coef(problem_.get(), column, 1);
    glp_smcp parameters;
    glp_init_smcp(&parameters);
    parameters.msg_lev = GLP_MSG_OFF;
    if (glp_simplex(problem_.get(), &parameters) != 0) throw std::runtime_error("GLPK failed");
    if (glp_get_status(problem_.get()) != GLP_OPT) throw std::runtime_error("no optimum");
    return glp_get_obj_val(problem_.get());
  }

 private:
  std::unique_ptr<glp_prob, void (*)(glp_prob*)> problem_;
  // Entry 0 is unused, because GLPK indices start at 1.
  std::vector<int> rows_ = {0}, columns_ = {0};
  std::vector<double> values_ = {0};
};

std::vector<Vector3d> EdgesOf(const SeenFrom& set, const ConePyramid& pyramid) {
  const double radius = pyramid.circumscribed
                            ? set.tangent / std::cos(std::numbers::pi / pyramid.sides)
                            : set.tangent;
  const Vector3d first = set.axis.unitOrthogonal();
  const Vector3d second = set.axis.cross(first);
  std::vector<Vector3d> edges;
  for (int side = 0; side < pyramid.sides; ++side) {
    const double angle = 2 * std::numbers::pi * side / pyramid.sides;
    edges.push_back(set.axis + radius * (std::cos(angle) * first + std::sin(angle) * second));
  }
  return edges;
}

}  // namespace

double ConeMargin(std::span<const SeenFrom> sets, const ConePyramid& pyramid, double scale,
                  double reach) {
  Program program;
  std::array<int, 3> x;
  for (int& axis : x) axis = program.AddColumn(GLP_DB, -reach, reach);
  // The lower bound is a margin so small that no test compares with it.
  const int margin = program.AddColumn(GLP_DB, -2 * reach, 1);
  for (const SeenFrom& set : sets) {
    const int point_row = program.AddRow(0);
    program.AddRow(0);
    program.AddRow(0);
    const int sum_row = program.AddRow(1);
    for (int axis = 0; axis < 3; ++axis) program.Set(point_row + axis, x[axis], -1);
    for (const Vector3d& corner : set.corners) {
      const int weight = program.AddColumn(GLP_LO, 0, 0);
      program.Set(point_row, weight, corner / scale);
      program.Set(sum_row, weight, 1);
    }
    if (set.axis.isZero(0)) continue;
    // μ = ν + t with ν ≥ 0: t multiplies the sum of the edges, each ν one edge.
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& edge : EdgesOf(set, pyramid)) {
      program.Set(point_row, program.AddColumn(GLP_LO, 0, 0), edge);
      sum += edge;
    }
    program.Set(point_row, margin, sum);
  }
  return program.Maximise(margin);
}

Verdict DecideByPyramids(std::span<const SeenFrom> sets, double scale) {
  if (ConeMargin(sets, {kSides, false}, scale, kInscribedReach) > kLeastMargin) {
    return Verdict::kMeet;
  }
  const double most = ConeMargin(sets, {kSides, true}, scale, kCircumscribedReach);
  if (most < -kLeastMargin) return Verdict::kApart;
  return most > kLeastMargin ? Verdict::kBetween : Verdict::kTouch;
}

}  // namespace regrasp::polyhedron
