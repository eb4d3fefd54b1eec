#include "planner/sets/polygon/switch_point.h"

#include <algorithm>
#include <limits>

#include "planner/sets/polygon/slack_program.h"

namespace regrasp::polygon {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Smallest increase of the score that justifies a move: 0.006° of margin.
constexpr double kLeastGain = 1e-4;

/// Fraction of the largest slack that an improved switch keeps, so that contacts stay away from
/// corners and sliding steps from the set's border.
constexpr double kKeptShare = 0.25;

/// Return the cells of a set; if the grasp is given, only those that contain it.
std::vector<const GraspCell*> CellsOf(const SwitchSide& side) {
  std::vector<const GraspCell*> cells;
  for (const GraspCell& cell : side.cells->cells()) {
    if (!side.fixed || SlackInCell(cell, *side.fixed) > kNoSlack) cells.push_back(&cell);
  }
  return cells;
}

/// Concatenate the inequalities of two cells, with the variables of the first one first.
Inequalities Join(const Inequalities& a, const Inequalities& b) {
  Inequalities both;
  both.rows = Eigen::MatrixXd::Zero(a.rows.rows() + b.rows.rows(), a.rows.cols() + b.rows.cols());
  both.rows.topLeftCorner(a.rows.rows(), a.rows.cols()) = a.rows;
  both.rows.bottomRightCorner(b.rows.rows(), b.rows.cols()) = b.rows;
  both.offsets.resize(both.rows.rows());
  both.offsets << a.offsets, b.offsets;
  return both;
}

std::optional<SwitchPoint> FindInCells(const SwitchSide& from, const Inequalities& from_cell,
                                       const SwitchSide& to, const Inequalities& to_cell,
                                       const CommonEdges& kept) {
  const Index from_contacts = std::ssize(from.set->edges);
  const Index to_contacts = std::ssize(to.set->edges);
  const Index first_of_to = from_cell.rows.cols();
  Substitution joint(first_of_to + to_cell.rows.cols());
  for (Index k = 0; from.fixed && k < from_contacts; ++k) joint.Fix(k, (*from.fixed)[k]);
  for (Index k = 0; to.fixed && k < to_contacts; ++k) joint.Fix(first_of_to + k, (*to.fixed)[k]);
  for (const auto& [in_from, in_to] : kept) joint.Join(in_from, first_of_to + in_to);
  if (!joint.Finish()) return std::nullopt;
  const SlackSolution solution = MaximizeSlack(joint.Apply(Join(from_cell, to_cell)));
  if (solution.slack <= kNoSlack) return std::nullopt;
  const VectorXd both = joint.Expand(solution.z);
  SwitchPoint point = {
      both.head(from_contacts), both.segment(first_of_to, to_contacts), {}, solution.slack};
  for (const auto& [in_from, in_to] : kept) point.kept.push_back(from.set->edges[in_from]);
  return point;
}

/// Movable contact: positions in the first grasp, in the second one, or in both if it is kept (−1:
/// none).
struct FreeContact {
  Index in_from = -1;
  Index in_to = -1;
  double length = 1;  ///< length of its edge divided by D
};

std::vector<FreeContact> FindFreeContacts(const SwitchSide& from, const SwitchSide& to,
                                          const SwitchPoint& point) {
  std::vector<FreeContact> contacts;
  for (std::size_t k = 0; k < from.set->edges.size(); ++k) {
    contacts.push_back({static_cast<Index>(k), -1, from.cells->edge_length(static_cast<int>(k))});
  }
  for (std::size_t k = 0; k < to.set->edges.size(); ++k) {
    const FaceIndex edge = to.set->edges[k];
    if (std::ranges::binary_search(point.kept, edge)) {
      const auto in_from = std::ranges::find(from.set->edges, edge) - from.set->edges.begin();
      contacts[in_from].in_to = static_cast<Index>(k);
    } else {
      contacts.push_back({-1, static_cast<Index>(k), to.cells->edge_length(static_cast<int>(k))});
    }
  }
  return contacts;
}

/// Scores of a switch's two grasps, lower one first. If the lower score stays the same, a higher
/// second score is an improvement; otherwise the search would stop at equal scores.
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

/// Compass search of ImproveSwitch.
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

  /// Move one contact. @returns whether the switch improves; `point` is then the new one.
  bool Move(const FreeContact& contact, double by, SwitchPoint& point) const {
    SwitchPoint next = point;
    if (contact.in_from >= 0) next.before[contact.in_from] += by;
    if (contact.in_to >= 0) next.after[contact.in_to] += by;
    if (!RankOf(next).IsBetterThan(RankOf(point))) return false;
    // The more expensive test is last.
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
  const CommonEdges common = FindCommonEdges(from.set->edges, to.set->edges);
  const int contacts = static_cast<int>(from.set->edges.size() + to.set->edges.size());
  const int least_kept = std::max(0, contacts - fingers);
  const std::vector<const GraspCell*> from_cells = CellsOf(from);
  const std::vector<const GraspCell*> to_cells = CellsOf(to);
  std::vector<SwitchPoint> points;
  for (unsigned subset = 0; subset < 1U << common.size(); ++subset) {
    CommonEdges kept;
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
