#include "planner/sets/polygon/set_cells.h"

#include <glpk.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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
    throw std::runtime_error("linear program of grasps not solved");
  }
  // The multipliers of the dual's rows are the solution of the primal program.
  SlackSolution solution;
  solution.z.resize(set.rows.cols());
  for (int j = 0; j < solution.z.size(); ++j) solution.z[j] = -glp_get_row_dual(dual.get(), j + 1);
  solution.slack = set.SlackAt(solution.z);
  return solution;
}

CommonEdges FindCommonEdges(std::span<const FaceIndex> a, std::span<const FaceIndex> b) {
  CommonEdges common;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) {
      common.emplace_back(static_cast<int>(i++), static_cast<int>(j++));
    } else {
      ++(a[i] < b[j] ? i : j);
    }
  }
  return common;
}

using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Affine function of the variables, built term by term.
struct Affine {
  VectorXd rates;
  double constant = 0;
};

/// Edge relative to the centroid, divided by D, with unit vectors along the borders of its cone.
struct Edge {
  Vector2d a;
  Vector2d along;
  Vector2d right;
  Vector2d left;
};

/// Computes the cells of one set.
class CellMaker {
 public:
  CellMaker(const object::Polygon& polygon, const GraspSet& set) : set_(set) {
    const Vector2d centre = polygon.mass_properties().centroid.head<2>();
    const double d = polygon.diameter();
    for (const FaceIndex e : set.edges) {
      const auto [a, b] = polygon.edge(FaceIndex(e));
      Edge edge;
      edge.a = (a.head<2>() - centre) / d;
      edge.along = (b - a).head<2>() / d;
      const Vector2d normal(-edge.along.y(), edge.along.x());
      edge.right = (normal + set.tangent * edge.along).normalized();
      edge.left = (normal - set.tangent * edge.along).normalized();
      edges_.push_back(edge);
    }
  }

  std::vector<GraspCell> Make() {
    for (const int part : set_.parts) {
      switch (set_.type) {
        case GraspType::kConcurrent:
          MakeConcurrent(part);
          break;
        case GraspType::kTwoFinger:
          MakeTwoFinger(part);
          break;
        case GraspType::kParallel:
          MakeParallel(part);
          break;
      }
    }
    return std::move(cells_);
  }

  [[nodiscard]] double ClearWidth() const {
    double width = 0;
    for (const int a : set_.parts) {
      const auto [b, c] = OuterOf(a);
      const auto [right, left] = CommonConeOf(a, b, c);
      for (const double sign : {1.0, -1.0}) {
        std::vector<Affine> list = InsideEdges();
        for (const Vector2d& border : {right, left}) {
          AddSide(border, b, a, sign, list);
          AddSide(border, c, a, -sign, list);
        }
        width = std::max(width, MaximizeSlack(Stack(list)).slack);
      }
    }
    return width;
  }

  /// Find the grasp of largest slack with the focus point on the line of edge k.
  ///
  /// The focus point is then at the contact, the only common point of the cones on both sides.
  [[nodiscard]] SlackSolution FocusAtContact(int part, int k) const {
    std::vector<Affine> list = InsideEdges();
    for (int j = 0; j < 3; ++j) {
      if (j != k) AddCone(j, IsOuter(part, j), list);
    }
    Inequalities set = Stack(list);
    // Substitute x = p_k for the focus point.
    Eigen::MatrixXd substitution = Eigen::MatrixXd::Zero(variables(), contacts());
    substitution.topRows(contacts()).setIdentity();
    substitution.col(k).tail(2) = edges_[k].along;
    VectorXd constant = VectorXd::Zero(variables());
    constant.tail(2) = edges_[k].a;
    set.offsets += set.rows * constant;
    set.rows = set.rows * substitution;
    return MaximizeSlack(set);
  }

 private:
  [[nodiscard]] int contacts() const { return static_cast<int>(edges_.size()); }
  [[nodiscard]] int variables() const {
    return contacts() + (set_.type == GraspType::kConcurrent ? 2 : 0);
  }

  [[nodiscard]] Affine Zero() const { return {VectorXd::Zero(variables()), 0}; }

  /// Add sign · cross(direction, p_k).
  void AddContact(const Vector2d& direction, int k, double sign, Affine& f) const {
    f.constant += sign * Cross(direction, edges_[k].a);
    f.rates[k] += sign * Cross(direction, edges_[k].along);
  }
  /// Add sign · cross(direction, x), with x the focus point.
  void AddFocus(const Vector2d& direction, double sign, Affine& f) const {
    f.rates[contacts()] += sign * -direction.y();
    f.rates[contacts() + 1] += sign * direction.x();
  }

  /// Return the inequalities that keep contacts away from the ends of their edges.
  [[nodiscard]] std::vector<Affine> InsideEdges() const {
    std::vector<Affine> list;
    for (int k = 0; k < contacts(); ++k) {
      const double length = edges_[k].along.norm();
      Affine first = Zero();
      first.rates[k] = length;
      Affine second = Zero();
      second.rates[k] = -length;
      second.constant = length;
      list.push_back(first);
      list.push_back(second);
    }
    return list;
  }

  static Inequalities Stack(const std::vector<Affine>& list) {
    Inequalities set;
    set.rows.resize(static_cast<Eigen::Index>(list.size()), list.front().rates.size());
    set.offsets.resize(static_cast<Eigen::Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) {
      set.rows.row(static_cast<Eigen::Index>(i)) = list[i].rates;
      set.offsets[static_cast<Eigen::Index>(i)] = list[i].constant;
    }
    return set;
  }

  void AddCell(int part, const std::vector<Affine>& list) {
    Inequalities inequalities = Stack(list);
    SlackSolution centre = MaximizeSlack(inequalities);
    if (centre.slack > kNoSlack) {
      cells_.push_back({part, std::move(inequalities), std::move(centre)});
    }
  }

  /// Add the inequalities of a focus point inside the cone at contact k.
  void AddCone(int k, bool outer, std::vector<Affine>& list) const {
    const double side = outer ? -1 : 1;
    for (const auto& [border, sign] : {std::pair(edges_[k].right, 1.0), {edges_[k].left, -1.0}}) {
      Affine f = Zero();
      AddFocus(border, side * sign, f);
      AddContact(border, k, -side * sign, f);
      list.push_back(f);
    }
  }

  void MakeConcurrent(int part) {
    std::vector<Affine> list = InsideEdges();
    for (int k = 0; k < 3; ++k) AddCone(k, IsOuter(part, k), list);
    AddCell(part, list);
  }

  void MakeTwoFinger(int part) {
    std::vector<Affine> list = InsideEdges();
    const double sign = part == 0 ? 1 : -1;
    // v = p_1 − p_0 is inside the cone at 0 and −v inside the cone at 1, or both with reversed
    // sign.
    const auto add = [&](const Vector2d& border, double side) {
      Affine f = Zero();
      AddContact(border, 1, sign * side, f);
      AddContact(border, 0, -sign * side, f);
      list.push_back(f);
    };
    add(edges_[0].right, 1);
    add(edges_[0].left, -1);
    add(edges_[1].right, -1);
    add(edges_[1].left, 1);
    AddCell(part, list);
  }

  /// Make the eight cells of parallel grasps with centre a.
  ///
  /// In a cell, f of b is positive and f of c is negative or vice versa, each for one border of the
  /// common cone (see planner/sets/polygon/parallel.h for f). The cells overlap and omit only
  /// grasps with two contacts at one point.
  void MakeParallel(int a) {
    const auto [b, c] = OuterOf(a);
    const auto [right, left] = CommonConeOf(a, b, c);
    const std::array<Vector2d, 2> borders = {right, left};
    for (const double sign : {1.0, -1.0}) {
      for (const Vector2d& of_b : borders) {
        for (const Vector2d& of_c : borders) {
          std::vector<Affine> list = InsideEdges();
          AddSide(of_b, b, a, sign, list);
          AddSide(of_c, c, a, -sign, list);
          AddCell(a, list);
        }
      }
    }
  }

  /// Add the inequality sign · cross(border, p_x − p_a) > 0.
  void AddSide(const Vector2d& border, int x, int a, double sign, std::vector<Affine>& list) const {
    Affine f = Zero();
    AddContact(border, x, sign, f);
    AddContact(border, a, -sign, f);
    list.push_back(f);
  }

  /// Return the borders of the intersection of the cones of b and c and the reversed cone of a. All
  /// borders are within π of each other, so the innermost ones bound the intersection.
  [[nodiscard]] std::pair<Vector2d, Vector2d> CommonConeOf(int a, int b, int c) const {
    const auto is_inside = [&](const Vector2d& w, int k, double side) {
      return Cross(side * edges_[k].right, w) >= -kNoSlack &&
             Cross(w, side * edges_[k].left) >= -kNoSlack;
    };
    const auto innermost = [&](auto border) {
      for (const auto& [k, side] : {std::pair(a, -1.0), {b, 1.0}, {c, 1.0}}) {
        const Vector2d w = side * border(edges_[k]);
        if (is_inside(w, a, -1) && is_inside(w, b, 1) && is_inside(w, c, 1)) return w;
      }
      // No border is inside only if the common cone is too narrow for doubles.
      return Vector2d(-border(edges_[a]));
    };
    return {innermost([](const Edge& e) { return e.right; }),
            innermost([](const Edge& e) { return e.left; })};
  }

  const GraspSet& set_;
  std::vector<Edge> edges_;
  std::vector<GraspCell> cells_;
};

}  // namespace

SetCells::SetCells(const object::Polygon& polygon, const GraspSet& set)
    : polygon_(polygon), set_(set), cells_(CellMaker(polygon, set).Make()) {}

std::optional<VectorXd> SetCells::Passage(sets::PieceIndex from, sets::PieceIndex to) const {
  const GraspCell& a = cells_[from];
  const GraspCell& b = cells_[to];
  const auto contacts = static_cast<Eigen::Index>(set_.edges.size());
  SlackSolution point;
  if (set_.type == GraspType::kConcurrent) {
    const auto differ = static_cast<unsigned>(a.part ^ b.part);
    if (!std::has_single_bit(differ)) return std::nullopt;
    point = CellMaker(polygon_, set_).FocusAtContact(a.part, std::countr_zero(differ));
  } else {
    Inequalities both;
    both.rows.resize(a.inequalities.rows.rows() + b.inequalities.rows.rows(), contacts);
    both.rows << a.inequalities.rows, b.inequalities.rows;
    both.offsets.resize(both.rows.rows());
    both.offsets << a.inequalities.offsets, b.inequalities.offsets;
    point = MaximizeSlack(both);
  }
  if (point.slack <= kNoSlack) return std::nullopt;
  return point.z.head(contacts);
}

double SetCells::width() const {
  double width = 0;
  for (const GraspCell& cell : cells_) width = std::max(width, cell.centre.slack);
  return width;
}

double ClearWidth(const object::Polygon& polygon, const GraspSet& parallel) {
  return CellMaker(polygon, parallel).ClearWidth();
}

double SlackInCell(const GraspCell& cell, const VectorXd& parameters) {
  const Inequalities& all = cell.inequalities;
  const Eigen::Index contacts = parameters.size();
  const Eigen::Index rest = all.rows.cols() - contacts;
  const Inequalities fixed = {all.rows.rightCols(rest),
                              all.offsets + all.rows.leftCols(contacts) * parameters};
  return rest == 0 ? fixed.offsets.minCoeff() : MaximizeSlack(fixed).slack;
}

bool IsInSet(const SetCells& set, const VectorXd& parameters, double slack) {
  return std::any_of(set.cells().begin(), set.cells().end(),
                     [&](const GraspCell& cell) { return SlackInCell(cell, parameters) > slack; });
}

}  // namespace regrasp::polygon
