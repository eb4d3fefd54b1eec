#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

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

/// Variables some of which have given values, and some of which are the same: what is left of them
/// are free ones.
class Substitution {
 public:
  explicit Substitution(Eigen::Index variables)
      : values_(Eigen::VectorXd::Zero(variables)), fixed_(variables), column_(variables) {}

  void Fix(Eigen::Index variable, double value);
  /// @param second  > first; joined to no other.
  void Join(Eigen::Index first, Eigen::Index second) { joined_.emplace_back(first, second); }

  /// Numbers the free variables; before what follows.
  /// @returns false where two values of one variable differ.
  [[nodiscard]] bool Finish();

  /// The inequalities of all variables as those of the free ones.
  [[nodiscard]] Inequalities Apply(const Inequalities& all) const;
  /// All variables, of the free ones.
  [[nodiscard]] Eigen::VectorXd Expand(const Eigen::VectorXd& free) const;

 private:
  Eigen::VectorXd values_;
  std::vector<bool> fixed_;
  std::vector<Eigen::Index> column_;  ///< of a free variable: its number
  std::vector<std::pair<Eigen::Index, Eigen::Index>> joined_;
  Eigen::Index free_count_ = 0;
};

}  // namespace regrasp::polygon
