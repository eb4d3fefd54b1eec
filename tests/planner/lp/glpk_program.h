#pragma once

#include <Eigen/Core>
#include <optional>

namespace regrasp::lp {

/// Program with a list of columns: minimise costs · λ over λ ≥ 0 with columns λ = right.
struct ListedProgram {
  Eigen::MatrixXd columns;
  Eigen::VectorXd costs;
  Eigen::VectorXd right;
};

struct GlpkAnswer {
  bool feasible = false;
  std::optional<double> least;  ///< nullopt also if the objective is unbounded
};

/// Solve a program by GLPK's simplex method, an independent reference for Simplex.
/// @throws std::runtime_error  if GLPK fails.
[[nodiscard]] GlpkAnswer SolveByGlpk(const ListedProgram& program);

}  // namespace regrasp::lp
