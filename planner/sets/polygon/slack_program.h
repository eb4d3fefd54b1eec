#pragma once

#include <Eigen/Core>

namespace regrasp::polygon {

/// The inequalities rows · z + offsets > 0 of a convex set.
struct Inequalities {
  Eigen::MatrixXd rows;
  Eigen::VectorXd offsets;

  /// The smallest of rows · z + offsets.
  [[nodiscard]] double SlackAt(const Eigen::VectorXd& z) const {
    return (rows * z + offsets).minCoeff();
  }
};

struct SlackSolution {
  Eigen::VectorXd z;
  double slack = 0;  ///< as SlackAt says it; not positive where the set has no interior
};

/// The point of a convex set with the largest smallest slack, by a linear program (GLPK's simplex).
/// Slack beyond `enough` counts for nothing, so that there is always an answer.
/// @throws std::runtime_error  the solver fails.
[[nodiscard]] SlackSolution MaximizeSlack(const Inequalities& set, double enough = 1);

}  // namespace regrasp::polygon
