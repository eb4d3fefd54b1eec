#include "tests/planner/lp/glpk_program.h"

#include <glpk.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace regrasp::lp {

GlpkAnswer SolveByGlpk(const ListedProgram& program) {
  const std::unique_ptr<glp_prob, void (*)(glp_prob*)> problem(glp_create_prob(), &glp_delete_prob);
  const int rows = static_cast<int>(program.columns.rows());
  const int columns = static_cast<int>(program.columns.cols());
  glp_set_obj_dir(problem.get(), GLP_MIN);
  glp_add_rows(problem.get(), rows);
  glp_add_cols(problem.get(), columns);
  // GLPK's indices start at 1.
  std::vector<int> at(rows + 1);
  std::vector<double> entries(rows + 1);
  for (int r = 1; r <= rows; ++r) {
    at[r] = r;
    glp_set_row_bnds(problem.get(), r, GLP_FX, program.right[r - 1], program.right[r - 1]);
  }
  for (int c = 1; c <= columns; ++c) {
    glp_set_col_bnds(problem.get(), c, GLP_LO, 0, 0);
    glp_set_obj_coef(problem.get(), c, program.costs[c - 1]);
    for (int r = 1; r <= rows; ++r) entries[r] = program.columns(r - 1, c - 1);
    glp_set_mat_col(problem.get(), c, rows, at.data(), entries.data());
  }
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  if (glp_simplex(problem.get(), &parameters) != 0) throw std::runtime_error("GLPK failed");
  const int status = glp_get_status(problem.get());
  if (status == GLP_OPT) return {true, glp_get_obj_val(problem.get())};
  return {status == GLP_UNBND, std::nullopt};
}

}  // namespace regrasp::lp
