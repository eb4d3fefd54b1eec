#pragma once

#include <Eigen/Core>
#include <optional>

namespace regrasp::lp {

/// A program with its columns written out: minimise costs · λ over λ ≥ 0 with columns λ = right.
struct ListedProgram {
  Eigen::MatrixXd columns;
  Eigen::VectorXd costs;
  Eigen::VectorXd right;
};

struct GlpkAnswer {
  bool feasible = false;
  std::optional<double> least;  ///< none also where the objective has no bound
};

/// A second route to what Simplex computes: GLPK's simplex method.
/// @throws std::runtime_error  it fails.
[[nodiscard]] GlpkAnswer SolveByGlpk(const ListedProgram& program);

}  // namespace regrasp::lp
