#pragma once

#include <utility>
#include <vector>

#include "planner/sets/polygon/slack_program.h"

namespace regrasp::polygon {

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
