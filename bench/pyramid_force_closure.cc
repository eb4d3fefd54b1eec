#include "bench/pyramid_force_closure.h"

#include <glpk.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace regrasp {

PyramidWrenches WrenchesOfPyramids(const grasp::Grasp& grasp, double friction_angle) {
  PyramidWrenches wrenches;
  int column = 0;
  for (const grasp::Contact& contact : grasp) {
    const Eigen::Vector3d first = contact.n.unitOrthogonal();
    const Eigen::Vector3d second = contact.n.cross(first);
    for (int side = 0; side < kBenchSides; ++side) {
      const double angle = 2 * std::numbers::pi * side / kBenchSides;
      const Eigen::Vector3d force =
          contact.n +
          std::tan(friction_angle) * (std::cos(angle) * first + std::sin(angle) * second);
      wrenches.col(column++) << force, contact.p.cross(force);
    }
  }
  return wrenches;
}

bool PyramidForceClosure(const grasp::Grasp& grasp, double friction_angle) {
  constexpr int kDimension = PyramidWrenches::RowsAtCompileTime;
  const PyramidWrenches wrenches = WrenchesOfPyramids(grasp, friction_angle);
  const int columns = static_cast<int>(wrenches.cols());
  const std::unique_ptr<glp_prob, void (*)(glp_prob*)> problem(glp_create_prob(), &glp_delete_prob);
  glp_add_rows(problem.get(), kDimension);
  glp_add_cols(problem.get(), columns);
  for (int row = 1; row <= kDimension; ++row) glp_set_row_bnds(problem.get(), row, GLP_FX, 0, 0);
  std::array<int, kDimension + 1> rows{0, 1, 2, 3, 4, 5, 6};
  std::array<double, kDimension + 1> values{};
  // Weights of at least 1 on all edges that balance exist iff the pyramids' interiors balance.
  for (int column = 0; column < columns; ++column) {
    glp_set_col_bnds(problem.get(), column + 1, GLP_LO, 1, 0);
    for (int row = 0; row < kDimension; ++row) values[row + 1] = wrenches(row, column);
    glp_set_mat_col(problem.get(), column + 1, kDimension, rows.data(), values.data());
  }
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.presolve = GLP_OFF;
  glp_simplex(problem.get(), &parameters);
  return glp_get_status(problem.get()) == GLP_OPT;
}

}  // namespace regrasp
