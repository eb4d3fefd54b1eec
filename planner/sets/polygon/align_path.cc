#include "planner/sets/polygon/align_path.h"

#include <algorithm>
#include <deque>

namespace regrasp::polygon {

using Eigen::VectorXd;

namespace {

std::vector<char> CellsWith(const SetCells& set, const VectorXd& parameters) {
  std::vector<char> contain;
  for (const GraspCell& cell : set.cells()) {
    contain.push_back(SlackInCell(cell, parameters) > kNoSlack ? 1 : 0);
  }
  return contain;
}

}  // namespace

std::vector<VectorXd> FindAlignPath(const SetCells& set, const VectorXd& from, const VectorXd& to) {
  const std::vector<char> starts = CellsWith(set, from);
  const std::vector<char> goals = CellsWith(set, to);
  const int count = static_cast<int>(set.cells().size());
  // Breadth first over cells: where each was reached from, and through which grasp.
  constexpr int kUnseen = -2;
  constexpr int kStart = -1;
  std::vector<int> before(count, kUnseen);
  std::vector<VectorXd> through(count);
  std::deque<int> queue;
  for (int cell = 0; cell < count; ++cell) {
    if (starts[cell] == 0) continue;
    before[cell] = kStart;
    queue.push_back(cell);
  }
  // A cell that holds both ends needs no passage.
  for (int cell = 0; cell < count; ++cell) {
    if (starts[cell] != 0 && goals[cell] != 0) return {from, to};
  }
  while (!queue.empty()) {
    const int cell = queue.front();
    queue.pop_front();
    for (int next = 0; next < count; ++next) {
      if (before[next] != kUnseen) continue;
      std::optional<VectorXd> passage = set.Passage(cell, next);
      if (!passage) continue;
      before[next] = cell;
      through[next] = std::move(*passage);
      queue.push_back(next);
      if (goals[next] == 0) continue;
      std::vector<VectorXd> path = {to};
      for (int at = next; before[at] != kStart; at = before[at]) path.push_back(through[at]);
      path.push_back(from);
      std::reverse(path.begin(), path.end());
      return path;
    }
  }
  return {};
}

}  // namespace regrasp::polygon
