#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace regrasp::polygon {

/// Inequalities rows · z + offsets > 0 of a convex set.
struct Inequalities {
  Eigen::MatrixXd rows;
  Eigen::VectorXd offsets;

  /// Return the smallest element of rows · z + offsets.
  [[nodiscard]] double SlackAt(const Eigen::VectorXd& z) const {
    return (rows * z + offsets).minCoeff();
  }
};

struct SlackSolution {
  Eigen::VectorXd z;
  double slack = 0;  ///< see SlackAt; not positive if the set has no interior
};

/// Find the point of a convex set that maximizes its slack, by a linear program (GLPK's simplex).
/// @param enough  upper bound on the slack, so that there is always a solution.
/// @throws std::runtime_error  if the solver fails.
[[nodiscard]] SlackSolution MaximizeSlack(const Inequalities& set, double enough = 1);

/// Substitution of variables: some have fixed values, and some pairs are equal. The remaining ones
/// are free.
class Substitution {
 public:
  explicit Substitution(Eigen::Index variables)
      : values_(Eigen::VectorXd::Zero(variables)), fixed_(variables), column_(variables) {}

  void Fix(Eigen::Index variable, double value);
  /// Declare two variables equal.
  /// @param second  index above `first`; not joined with any other variable.
  void Join(Eigen::Index first, Eigen::Index second) { joined_.emplace_back(first, second); }

  /// Number the free variables. Call it before the functions below.
  /// @returns false if two fixed values of equal variables differ.
  [[nodiscard]] bool Finish();

  /// Convert inequalities of all variables to inequalities of the free ones.
  [[nodiscard]] Inequalities Apply(const Inequalities& all) const;
  /// Return the values of all variables for values of the free ones.
  [[nodiscard]] Eigen::VectorXd Expand(const Eigen::VectorXd& free) const;

 private:
  Eigen::VectorXd values_;
  std::vector<bool> fixed_;
  std::vector<Eigen::Index> column_;  ///< number of each free variable
  std::vector<std::pair<Eigen::Index, Eigen::Index>> joined_;
  Eigen::Index free_count_ = 0;
};

}  // namespace regrasp::polygon
