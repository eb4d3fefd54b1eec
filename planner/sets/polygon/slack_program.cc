#include "planner/sets/polygon/slack_program.h"

#include <glpk.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

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

namespace {

struct DeleteProgram {
  void operator()(glp_prob* program) const { glp_delete_prob(program); }
};
using Program = std::unique_ptr<glp_prob, DeleteProgram>;

/// Make the dual of: maximize t subject to rows · z + offsets ≥ t, t ≤ enough.
///
/// It has one row per variable and one for t, instead of one per inequality; GLPK's time is
/// quadratic in the number of rows:
///
///     minimize offsets · y + enough · y_t   over y, y_t ≥ 0 with rowsᵀ y = 0, Σ y + y_t = 1.
///
/// It is always feasible (y_t = 1), and bounded iff the inequalities hold for some t.
Program MakeDual(const Inequalities& set, double enough) {
  const int inequalities = static_cast<int>(set.rows.rows());
  const int variables = static_cast<int>(set.rows.cols());
  Program program(glp_create_prob());
  glp_set_obj_dir(program.get(), GLP_MIN);
  glp_add_rows(program.get(), variables + 1);
  glp_add_cols(program.get(), inequalities + 1);
  // GLPK indices start at 1.
  std::vector<int> row_of = {0};
  std::vector<int> column_of = {0};
  std::vector<double> values = {0};
  const auto add = [&](int row, int column, double value) {
    row_of.push_back(row);
    column_of.push_back(column);
    values.push_back(value);
  };
  for (int j = 1; j <= variables; ++j) glp_set_row_bnds(program.get(), j, GLP_FX, 0, 0);
  glp_set_row_bnds(program.get(), variables + 1, GLP_FX, 1, 1);
  for (int i = 1; i <= inequalities + 1; ++i) {
    const bool last = i > inequalities;
    glp_set_col_bnds(program.get(), i, GLP_LO, 0, 0);
    glp_set_obj_coef(program.get(), i, last ? enough : set.offsets[i - 1]);
    add(variables + 1, i, 1);
    for (int j = 1; j <= variables && !last; ++j) {
      if (set.rows(i - 1, j - 1) != 0) add(j, i, set.rows(i - 1, j - 1));
    }
  }
  glp_load_matrix(program.get(), static_cast<int>(values.size()) - 1, row_of.data(),
                  column_of.data(), values.data());
  return program;
}

}  // namespace

SlackSolution MaximizeSlack(const Inequalities& set, double enough) {
  const Program dual = MakeDual(set, enough);
  glp_smcp options;
  glp_init_smcp(&options);
  options.msg_lev = GLP_MSG_OFF;
  if (glp_simplex(dual.get(), &options) != 0 || glp_get_status(dual.get()) != GLP_OPT) {
    throw std::runtime_error("a linear program of grasps could not be solved");
  }
  // The multipliers of the dual's rows are the solution of the primal program.
  SlackSolution solution;
  solution.z.resize(set.rows.cols());
  for (int j = 0; j < solution.z.size(); ++j) solution.z[j] = -glp_get_row_dual(dual.get(), j + 1);
  solution.slack = set.SlackAt(solution.z);
  return solution;
}

}  // namespace regrasp::polygon
