#include "planner/polygon/switch_point.h"

#include <algorithm>

namespace regrasp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A share of the best slack that a switch may lose for keeping more contacts in place.
constexpr double kGoodShare = 0.5;

/// An edge that both sets have, by its positions in them.
struct CommonEdge {
  int edge;
  int in_from;
  int in_to;
};

std::vector<CommonEdge> FindCommonEdges(const GraspSet& from, const GraspSet& to) {
  std::vector<CommonEdge> common;
  for (std::size_t i = 0; i < from.edges.size(); ++i) {
    const auto found = std::find(to.edges.begin(), to.edges.end(), from.edges[i]);
    if (found == to.edges.end()) continue;
    common.push_back(
        {from.edges[i], static_cast<int>(i), static_cast<int>(found - to.edges.begin())});
  }
  return common;
}

/// Both grasps in terms of free variables: all = matrix · free + constant, the first cell's
/// variables before the second's.
class JointVariables {
 public:
  JointVariables(Index from_variables, Index to_variables)
      : from_variables_(from_variables),
        column_(from_variables + to_variables, -1),
        constant_(VectorXd::Zero(from_variables + to_variables)),
        fixed_(from_variables + to_variables, false) {}

  void Fix(Index variable, double value) {
    fixed_[variable] = true;
    constant_[variable] = value;
  }
  /// A contact of the second grasp is one of the first.
  void Join(Index in_from, Index in_to) { same_as_.emplace_back(in_from, from_variables_ + in_to); }

  /// Numbers the free variables. @returns false where fixed contacts that are joined differ.
  bool Finish() {
    for (const auto& [first, second] : same_as_) {
      if (fixed_[first] && fixed_[second] && constant_[first] != constant_[second]) return false;
      if (fixed_[second]) Fix(first, constant_[second]);
      if (fixed_[first]) Fix(second, constant_[first]);
    }
    int next = 0;
    for (std::size_t v = 0; v < column_.size(); ++v) {
      if (fixed_[v]) continue;
      const auto joined = std::find_if(same_as_.begin(), same_as_.end(), [&](const auto& pair) {
        return pair.second == static_cast<Index>(v);
      });
      column_[v] = joined == same_as_.end() ? next++ : column_[joined->first];
    }
    free_count_ = next;
    return true;
  }

  [[nodiscard]] Inequalities Substitute(const Inequalities& from, const Inequalities& to) const {
    Inequalities joint;
    const Index rows = from.rows.rows() + to.rows.rows();
    joint.rows = MatrixXd::Zero(rows, free_count_);
    joint.offsets.resize(rows);
    joint.offsets << from.offsets, to.offsets;
    for (Index v = 0; v < static_cast<Index>(column_.size()); ++v) {
      const bool first = v < from_variables_;
      const Inequalities& cell = first ? from : to;
      const Index row = first ? 0 : from.rows.rows();
      const auto rates = cell.rows.col(first ? v : v - from_variables_);
      if (fixed_[v]) {
        joint.offsets.segment(row, rates.size()) += constant_[v] * rates;
      } else {
        joint.rows.col(column_[v]).segment(row, rates.size()) += rates;
      }
    }
    return joint;
  }

  [[nodiscard]] double ValueOf(Index variable, const VectorXd& free) const {
    return fixed_[variable] ? constant_[variable] : free[column_[variable]];
  }

 private:
  Index from_variables_;
  std::vector<int> column_;
  VectorXd constant_;
  std::vector<bool> fixed_;
  std::vector<std::pair<Index, Index>> same_as_;
  int free_count_ = 0;
};

std::optional<SwitchPoint> FindInCells(const SwitchSide& from, const Inequalities& from_cell,
                                       const SwitchSide& to, const Inequalities& to_cell,
                                       const std::vector<CommonEdge>& kept) {
  const Index from_contacts = static_cast<Index>(from.set->edges.size());
  const Index to_contacts = static_cast<Index>(to.set->edges.size());
  const Index from_variables = from_cell.rows.cols();
  JointVariables joint(from_variables, to_cell.rows.cols());
  for (Index k = 0; from.fixed && k < from_contacts; ++k) joint.Fix(k, (*from.fixed)[k]);
  for (Index k = 0; to.fixed && k < to_contacts; ++k) {
    joint.Fix(from_variables + k, (*to.fixed)[k]);
  }
  for (const CommonEdge& edge : kept) joint.Join(edge.in_from, edge.in_to);
  if (!joint.Finish()) return std::nullopt;
  const Inequalities inequalities = joint.Substitute(from_cell, to_cell);
  const SlackSolution solution = MaximizeSlack(inequalities);
  if (solution.slack <= kNoSlack) return std::nullopt;
  SwitchPoint point;
  point.slack = solution.slack;
  point.before.resize(from_contacts);
  point.after.resize(to_contacts);
  for (Index k = 0; k < from_contacts; ++k) point.before[k] = joint.ValueOf(k, solution.z);
  for (Index k = 0; k < to_contacts; ++k) {
    point.after[k] = joint.ValueOf(from_variables + k, solution.z);
  }
  for (const CommonEdge& edge : kept) point.kept.push_back(edge.edge);
  return point;
}

}  // namespace

std::optional<SwitchPoint> FindSwitchPoint(const SwitchSide& from, const SwitchSide& to,
                                           int fingers) {
  const std::vector<CommonEdge> common = FindCommonEdges(*from.set, *to.set);
  const int contacts = static_cast<int>(from.set->edges.size() + to.set->edges.size());
  const int least_kept = std::max(0, contacts - fingers);
  std::vector<SwitchPoint> points;
  double best = 0;
  for (unsigned subset = 0; subset < 1U << common.size(); ++subset) {
    std::vector<CommonEdge> kept;
    for (std::size_t i = 0; i < common.size(); ++i) {
      if ((subset >> i & 1U) != 0) kept.push_back(common[i]);
    }
    if (static_cast<int>(kept.size()) < least_kept) continue;
    for (const SetCell& from_cell : from.cells->cells()) {
      for (const SetCell& to_cell : to.cells->cells()) {
        // A switch has no more slack than either cell.
        if (std::min(from_cell.centre.slack, to_cell.centre.slack) < kGoodShare * best) continue;
        auto point = FindInCells(from, from_cell.inequalities, to, to_cell.inequalities, kept);
        if (!point) continue;
        best = std::max(best, point->slack);
        points.push_back(std::move(*point));
      }
    }
  }
  std::erase_if(points, [&](const SwitchPoint& p) { return p.slack < kGoodShare * best; });
  if (points.empty()) return std::nullopt;
  return *std::max_element(points.begin(), points.end(),
                           [](const SwitchPoint& a, const SwitchPoint& b) {
                             if (a.kept.size() != b.kept.size()) {
                               return a.kept.size() < b.kept.size();
                             }
                             return a.slack < b.slack;
                           });
}

}  // namespace regrasp
