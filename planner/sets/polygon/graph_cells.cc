#include "planner/sets/polygon/graph_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/sets/polygon/set_cells.h"
#include "planner/sets/set_graph.h"

namespace regrasp::polygon {

using Eigen::VectorXd;

namespace {

/// Number of steps after which a walk in a cell of at most five dimensions is independent of its
/// start.
constexpr int kWalkSteps = 32;

/// Sample a cell by hit and run (Smith 1984): move to a uniform point of a chord in a random
/// direction.
VectorXd WalkInside(const GraspCell& cell, RandomStream& random) {
  const Inequalities& set = cell.inequalities;
  VectorXd z = cell.centre.z;
  for (int step = 0; step < kWalkSteps; ++step) {
    VectorXd direction(z.size());
    for (double& x : direction) x = sets::DrawNormal(random);
    const VectorXd slack = set.rows * z + set.offsets;
    const VectorXd rate = set.rows * direction;
    double back = -std::numeric_limits<double>::infinity();
    double ahead = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < rate.size(); ++i) {
      if (rate[i] > 0) back = std::max(back, -slack[i] / rate[i]);
      if (rate[i] < 0) ahead = std::min(ahead, -slack[i] / rate[i]);
    }
    if (!std::isfinite(back) || !std::isfinite(ahead)) continue;
    z += (back + random.Uniform() * (ahead - back)) * direction;
  }
  return z;
}

/// Return all subsets of size 3, then of size 2, of `count` elements.
std::vector<std::vector<int>> SubsetsOf(int count) {
  std::vector<std::vector<int>> subsets;
  for (const std::size_t size : {3, 2}) {
    for (unsigned bits = 0; bits < 1U << count; ++bits) {
      std::vector<int> subset;
      for (int i = 0; i < count; ++i) {
        if ((bits >> i & 1U) != 0) subset.push_back(i);
      }
      if (subset.size() == size) subsets.push_back(std::move(subset));
    }
  }
  return subsets;
}

/// Given parameters of a set's contacts, in the order of its edges.
using FixedParameters = std::vector<std::optional<double>>;

/// Return all choices of a grasp's contacts to keep in a set on these edges, including none.
std::vector<FixedParameters> ChooseKept(const object::Polygon& polygon, const grasp::Grasp& grasp,
                                        const std::vector<FaceIndex>& edges) {
  std::vector<FixedParameters> choices = {FixedParameters()};
  for (const FaceIndex edge : edges) {
    std::vector<FixedParameters> longer;
    for (const FixedParameters& choice : choices) {
      longer.push_back(choice);
      longer.back().push_back(std::nullopt);
      for (const grasp::Contact& contact : grasp) {
        if (contact.face != edge) continue;
        longer.push_back(choice);
        longer.back().push_back(grasp::ParameterOf(polygon, contact));
      }
    }
    choices = std::move(longer);
  }
  return choices;
}

/// Find the point of largest slack of a cell with given values of its first variables.
SlackSolution MaximizeSlackWith(const Inequalities& cell, const FixedParameters& fixed) {
  Substitution given(cell.rows.cols());
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    if (fixed[v]) given.Fix(static_cast<Eigen::Index>(v), *fixed[v]);
  }
  static_cast<void>(given.Finish());
  const SlackSolution solution = MaximizeSlack(given.Apply(cell));
  return {given.Expand(solution.z), solution.slack};
}

}  // namespace

const SetCells& GraphCells::of(sets::SetIndex set) {
  deadline_.Check();
  std::optional<SetCells>& cells = cells_[set];
  if (!cells) cells.emplace(polygon_, graph_.sets()[set]);
  return *cells;
}

double GraphCells::WidthOf(sets::SetIndex set) {
  deadline_.Check();
  std::optional<double>& width = widths_[set];
  if (!width) {
    const GraspSet& grasps = graph_.sets()[set];
    const bool parallel = grasps.type == GraspType::kParallel;
    width = parallel ? ClearWidth(polygon_, grasps) : of(set).width();
  }
  return *width;
}

std::vector<sets::Attachment<PolygonPlace>> GraphCells::FindAttachments(const grasp::Grasp& grasp) {
  std::vector<sets::Attachment<PolygonPlace>> attachments;
  for (std::vector<int> contacts : SubsetsOf(static_cast<int>(grasp.size()))) {
    std::sort(contacts.begin(), contacts.end(),
              [&](int a, int b) { return grasp[a].face < grasp[b].face; });
    std::vector<FaceIndex> edges;
    VectorXd parameters(static_cast<Eigen::Index>(contacts.size()));
    for (const int contact : contacts) {
      parameters[static_cast<Eigen::Index>(edges.size())] =
          grasp::ParameterOf(polygon_, grasp[contact]);
      edges.push_back(grasp[contact].face);
    }
    if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) continue;
    for (const sets::SetIndex set : graph_.SetsOn(edges)) {
      if (!IsInSet(of(set), parameters)) continue;
      attachments.push_back({set, {set, parameters}, contacts.size() == grasp.size()});
    }
  }
  return attachments;
}

std::vector<sets::Attachment<PolygonPlace>> GraphCells::FindSwitches(const grasp::Grasp& grasp,
                                                                     int fingers) {
  std::vector<sets::Attachment<PolygonPlace>> attachments;
  for (sets::SetIndex set{0}; set < graph_.vertex_count(); ++set) {
    const std::vector<FaceIndex>& edges = graph_.sets()[set].edges;
    const int least_kept = static_cast<int>(grasp.size() + edges.size()) - fingers;
    for (const FixedParameters& fixed : ChooseKept(polygon_, grasp, edges)) {
      const auto kept = std::count_if(fixed.begin(), fixed.end(),
                                      [](const auto& parameter) { return parameter.has_value(); });
      if (kept < least_kept || kept == std::ssize(edges)) continue;
      SlackSolution best;
      for (const GraspCell& cell : of(set).cells()) {
        SlackSolution solution = MaximizeSlackWith(cell.inequalities, fixed);
        if (solution.slack > std::max(best.slack, kNoSlack)) best = std::move(solution);
      }
      if (best.slack > 0) {
        attachments.push_back({set, {set, best.z.head(std::ssize(edges))}, false});
      }
    }
  }
  return attachments;
}

std::optional<PolygonPlace> GraphCells::Draw(sets::SetIndex set, RandomStream& random) {
  const std::vector<GraspCell>& cells = of(set).cells();
  if (cells.empty()) return std::nullopt;
  const VectorXd z = WalkInside(cells[random.Index(cells.size())], random);
  return PolygonPlace{set, z.head(std::ssize(graph_.sets()[set].edges))};
}

grasp::Grasp GraphCells::GraspOf(const PolygonPlace& place) const {
  grasp::Grasp grasp;
  for (const FaceIndex edge : graph_.sets()[place.set].edges) {
    const auto k = static_cast<Eigen::Index>(grasp.size());
    grasp.push_back(grasp::ContactAt(polygon_, edge, place.parameters[k]));
  }
  return grasp;
}

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
