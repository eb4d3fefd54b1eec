#include "planner/polygon/slack_program.h"

#include <glpk.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace regrasp {

namespace {

struct DeleteProgram {
  void operator()(glp_prob* program) const { glp_delete_prob(program); }
};

}  // namespace

SlackSolution MaximizeSlack(const Inequalities& set, double enough) {
  const int rows = static_cast<int>(set.rows.rows());
  const int variables = static_cast<int>(set.rows.cols());
  const int slack = variables + 1;
  const std::unique_ptr<glp_prob, DeleteProgram> program(glp_create_prob());
  glp_set_obj_dir(program.get(), GLP_MAX);
  glp_add_rows(program.get(), rows);
  glp_add_cols(program.get(), slack);
  for (int j = 1; j <= variables; ++j) glp_set_col_bnds(program.get(), j, GLP_FR, 0, 0);
  glp_set_col_bnds(program.get(), slack, GLP_UP, 0, enough);
  glp_set_obj_coef(program.get(), slack, 1);
  // GLPK counts from 1.
  std::vector<int> row_of = {0};
  std::vector<int> column_of = {0};
  std::vector<double> value = {0};
  const auto add = [&](int i, int j, double x) {
    row_of.push_back(i);
    column_of.push_back(j);
    value.push_back(x);
  };
  for (int i = 1; i <= rows; ++i) {
    glp_set_row_bnds(program.get(), i, GLP_LO, -set.offsets[i - 1], 0);
    for (int j = 1; j <= variables; ++j) {
      if (set.rows(i - 1, j - 1) != 0) add(i, j, set.rows(i - 1, j - 1));
    }
    add(i, slack, -1);
  }
  glp_load_matrix(program.get(), static_cast<int>(value.size()) - 1, row_of.data(),
                  column_of.data(), value.data());
  glp_smcp options;
  glp_init_smcp(&options);
  options.msg_lev = GLP_MSG_OFF;
  if (glp_simplex(program.get(), &options) != 0 || glp_get_status(program.get()) != GLP_OPT) {
    throw std::runtime_error("a linear program of grasps could not be solved");
  }
  SlackSolution solution;
  solution.z.resize(variables);
  for (int j = 0; j < variables; ++j) solution.z[j] = glp_get_col_prim(program.get(), j + 1);
  solution.slack = set.SlackAt(solution.z);
  return solution;
}

}  // namespace regrasp
