#include "planner/sets/polygon/switch_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace regrasp::polygon {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Moves that raise the score by less are not worth their time: 0.006° of margin.
constexpr double kLeastGain = 1e-4;

/// Of the most slack that a switch can have, so much stays when it is improved: contacts keep clear
/// of corners, and aligns have room.
constexpr double kKeptShare = 0.25;

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

/// The cells of a side; those that contain its grasp, where it has one.
std::vector<const GraspCell*> CellsOf(const SwitchSide& side) {
  std::vector<const GraspCell*> cells;
  for (const GraspCell& cell : side.cells->cells()) {
    if (!side.fixed || SlackInCell(cell, *side.fixed) > kNoSlack) cells.push_back(&cell);
  }
  return cells;
}

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

/// The parameters that a search may move: of a contact of the first grasp, of one of the second, or
/// of one that both have (positions; −1 for none).
struct FreeContact {
  Index in_from = -1;
  Index in_to = -1;
  double length = 1;  ///< of its edge over D
};

std::vector<FreeContact> FindFreeContacts(const SwitchSide& from, const SwitchSide& to,
                                          const SwitchPoint& point) {
  std::vector<FreeContact> contacts;
  for (std::size_t k = 0; k < from.set->edges.size(); ++k) {
    contacts.push_back({static_cast<Index>(k), -1, from.cells->edge_length(static_cast<int>(k))});
  }
  for (std::size_t k = 0; k < to.set->edges.size(); ++k) {
    const int edge = to.set->edges[k];
    if (std::binary_search(point.kept.begin(), point.kept.end(), edge)) {
      const auto in_from =
          std::find(from.set->edges.begin(), from.set->edges.end(), edge) - from.set->edges.begin();
      contacts[in_from].in_to = static_cast<Index>(k);
    } else {
      contacts.push_back({-1, static_cast<Index>(k), to.cells->edge_length(static_cast<int>(k))});
    }
  }
  return contacts;
}

/// A switch's two scores, the lower one first: where it stays the same, the other may rise, or the
/// search would end wherever both are equal.
class SwitchRank {
 public:
  SwitchRank(double before, double after)
      : lower_(std::min(before, after)), higher_(std::max(before, after)) {}

  [[nodiscard]] bool IsBetterThan(const SwitchRank& other) const {
    if (lower_ > other.lower_ + kLeastGain) return true;
    return lower_ >= other.lower_ && higher_ > other.higher_ + kLeastGain;
  }

 private:
  double lower_;
  double higher_;
};

/// See ImproveSwitch.
class CompassSearch {
 public:
  CompassSearch(const SwitchSide& from, const SwitchSide& to, const GraspScore& score,
                double least_slack)
      : from_(from), to_(to), score_(score), least_slack_(least_slack) {}

  [[nodiscard]] SwitchPoint Improve(const SwitchPoint& point) const {
    const std::vector<FreeContact> contacts = FindFreeContacts(from_, to_, point);
    SwitchPoint best = point;
    double step = kFirstStep;
    for (int round = 0; round < kMostRounds && step >= kLastStep; ++round) {
      bool improved = false;
      for (const FreeContact& contact : contacts) {
        improved = Move(contact, step / contact.length, best) ||
                   Move(contact, -step / contact.length, best) || improved;
      }
      if (!improved) step /= 2;
    }
    return best;
  }

 private:
  static constexpr double kFirstStep = 0.1;
  static constexpr double kLastStep = 0.003;
  static constexpr int kMostRounds = 20;

  /// @returns true where `point` is better after the move.
  bool Move(const FreeContact& contact, double by, SwitchPoint& point) const {
    SwitchPoint next = point;
    if (contact.in_from >= 0) next.before[contact.in_from] += by;
    if (contact.in_to >= 0) next.after[contact.in_to] += by;
    if (!RankOf(next).IsBetterThan(RankOf(point))) return false;
    // The costlier question comes last.
    if (contact.in_from >= 0 && !IsInSet(*from_.cells, next.before, least_slack_)) return false;
    if (contact.in_to >= 0 && !IsInSet(*to_.cells, next.after, least_slack_)) return false;
    point = std::move(next);
    return true;
  }

  [[nodiscard]] SwitchRank RankOf(const SwitchPoint& point) const {
    return {score_(*from_.set, point.before), score_(*to_.set, point.after)};
  }

  const SwitchSide& from_;
  const SwitchSide& to_;
  const GraspScore& score_;
  double least_slack_;
};

}  // namespace

std::vector<SwitchPoint> FindSwitchPoints(const SwitchSide& from, const SwitchSide& to,
                                          int fingers) {
  const std::vector<CommonEdge> common = FindCommonEdges(*from.set, *to.set);
  const int contacts = static_cast<int>(from.set->edges.size() + to.set->edges.size());
  const int least_kept = std::max(0, contacts - fingers);
  const std::vector<const GraspCell*> from_cells = CellsOf(from);
  const std::vector<const GraspCell*> to_cells = CellsOf(to);
  std::vector<SwitchPoint> points;
  for (unsigned subset = 0; subset < 1U << common.size(); ++subset) {
    std::vector<CommonEdge> kept;
    for (std::size_t i = 0; i < common.size(); ++i) {
      if ((subset >> i & 1U) != 0) kept.push_back(common[i]);
    }
    if (static_cast<int>(kept.size()) < least_kept) continue;
    for (const GraspCell* from_cell : from_cells) {
      for (const GraspCell* to_cell : to_cells) {
        auto point = FindInCells(from, from_cell->inequalities, to, to_cell->inequalities, kept);
        if (point) points.push_back(std::move(*point));
      }
    }
  }
  return points;
}

double ScoreOf(const SwitchSide& from, const SwitchSide& to, const SwitchPoint& point,
               const GraspScore& score) {
  double least = std::numeric_limits<double>::infinity();
  if (!from.fixed) least = std::min(least, score(*from.set, point.before));
  if (!to.fixed) least = std::min(least, score(*to.set, point.after));
  return least;
}

SwitchPoint ImproveSwitch(const SwitchSide& from, const SwitchSide& to, const SwitchPoint& point,
                          const GraspScore& score) {
  const CompassSearch search(from, to, score, kKeptShare * point.slack);
  return search.Improve(point);
}

}  // namespace regrasp::polygon
