#include "planner/polygon/graph_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace regrasp {

using Eigen::VectorXd;

namespace {

/// Steps after which a walk inside a cell of at most five dimensions has forgotten where it began.
constexpr int kWalkSteps = 32;

/// Hit and run (Smith 1984): a uniform point of a chord in a random direction, again and again.
VectorXd WalkInside(const GraspCell& cell, RandomStream& random) {
  const Inequalities& set = cell.inequalities;
  VectorXd z = cell.centre.z;
  for (int step = 0; step < kWalkSteps; ++step) {
    VectorXd direction(z.size());
    for (double& x : direction) {
      // Box and Muller: one normal deviate of two uniform ones.
      const double radius = std::sqrt(-2 * std::log(1 - random.Uniform()));
      x = radius * std::cos(2 * std::numbers::pi * random.Uniform());
    }
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

/// All subsets of 2 and 3 of `count` things, the larger ones first.
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

}  // namespace

const SetCells& GraphCells::of(int vertex) {
  std::optional<SetCells>& cells = cells_[vertex];
  if (!cells) cells.emplace(polygon_, graph_.sets()[vertex]);
  return *cells;
}

std::vector<Attachment> GraphCells::FindAttachments(const Grasp& grasp) {
  std::vector<Attachment> attachments;
  for (std::vector<int> contacts : SubsetsOf(static_cast<int>(grasp.size()))) {
    std::sort(contacts.begin(), contacts.end(),
              [&](int a, int b) { return grasp[a].face < grasp[b].face; });
    std::vector<int> edges;
    VectorXd parameters(static_cast<Eigen::Index>(contacts.size()));
    for (const int contact : contacts) {
      parameters[static_cast<Eigen::Index>(edges.size())] = ParameterOf(polygon_, grasp[contact]);
      edges.push_back(grasp[contact].face);
    }
    if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) continue;
    for (const int vertex : graph_.SetsOn(edges)) {
      if (!IsInSet(of(vertex), parameters)) continue;
      attachments.push_back({vertex, contacts, parameters});
    }
  }
  return attachments;
}

Grasp GraphCells::DrawGrasp(int vertex, RandomStream& random) {
  const std::vector<GraspCell>& cells = of(vertex).cells();
  Grasp grasp;
  if (cells.empty()) return grasp;
  const VectorXd z = WalkInside(cells[random.Index(cells.size())], random);
  for (const int edge : graph_.sets()[vertex].edges) {
    grasp.push_back(ContactAt(polygon_, edge, z[static_cast<Eigen::Index>(grasp.size())]));
  }
  return grasp;
}

}  // namespace regrasp
