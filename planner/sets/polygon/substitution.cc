#include "planner/sets/polygon/substitution.h"

#include <algorithm>

namespace regrasp::polygon {

using Eigen::Index;

void Substitution::Fix(Index variable, double value) {
  fixed_[variable] = true;
  values_[variable] = value;
}

bool Substitution::Finish() {
  for (const auto& [first, second] : joined_) {
    if (fixed_[first] && fixed_[second] && values_[first] != values_[second]) return false;
    if (fixed_[second]) Fix(first, values_[second]);
    if (fixed_[first]) Fix(second, values_[first]);
  }
  for (Index v = 0; v < values_.size(); ++v) {
    if (fixed_[v]) continue;
    const auto same = std::ranges::find(joined_, v, &std::pair<Index, Index>::second);
    column_[v] = same == joined_.end() ? free_count_++ : column_[same->first];
  }
  return true;
}

Inequalities Substitution::Apply(const Inequalities& all) const {
  Inequalities free = {Eigen::MatrixXd::Zero(all.rows.rows(), free_count_), all.offsets};
  for (Index v = 0; v < values_.size(); ++v) {
    if (fixed_[v]) {
      free.offsets += values_[v] * all.rows.col(v);
    } else {
      free.rows.col(column_[v]) += all.rows.col(v);
    }
  }
  return free;
}

Eigen::VectorXd Substitution::Expand(const Eigen::VectorXd& free) const {
  Eigen::VectorXd all = values_;
  for (Index v = 0; v < all.size(); ++v) {
    if (!fixed_[v]) all[v] = free[column_[v]];
  }
  return all;
}

}  // namespace regrasp::polygon
