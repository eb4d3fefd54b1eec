#include "planner/sets/polygon/graph_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/sets/polygon/slack_program.h"
#include "planner/sets/set_sampling.h"

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

}  // namespace regrasp::polygon
