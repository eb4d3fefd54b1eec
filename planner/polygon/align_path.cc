#include "planner/polygon/align_path.h"

#include <algorithm>
#include <deque>

namespace regrasp {

using Eigen::VectorXd;

namespace {

std::vector<char> CellsWith(const SetCells& set, const VectorXd& parameters) {
  std::vector<char> contain(set.cells.size(), 0);
  for (std::size_t i = 0; i < set.cells.size(); ++i) {
    contain[i] = SlackInCell(set.cells[i], parameters) > kNoSlack ? 1 : 0;
  }
  return contain;
}

}  // namespace

std::vector<VectorXd> FindAlignPath(const SetCells& set, const VectorXd& from, const VectorXd& to) {
  const std::vector<char> starts = CellsWith(set, from);
  const std::vector<char> goals = CellsWith(set, to);
  // Breadth first over cells; `by` is the passage through which a cell was reached first.
  constexpr int kUnseen = -2;
  constexpr int kStart = -1;
  std::vector<int> by(set.cells.size(), kUnseen);
  std::deque<int> queue;
  for (std::size_t i = 0; i < set.cells.size(); ++i) {
    if (!starts[i]) continue;
    by[i] = kStart;
    queue.push_back(static_cast<int>(i));
  }
  while (!queue.empty()) {
    const int cell = queue.front();
    queue.pop_front();
    if (goals[cell]) {
      std::vector<VectorXd> path = {to};
      for (int at = cell; by[at] != kStart; at = set.passages[by[at]].from) {
        path.push_back(set.passages[by[at]].point.z.head(to.size()));
      }
      path.push_back(from);
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (std::size_t p = 0; p < set.passages.size(); ++p) {
      const CellPassage& passage = set.passages[p];
      if (passage.from != cell || by[passage.to] != kUnseen) continue;
      by[passage.to] = static_cast<int>(p);
      queue.push_back(passage.to);
    }
  }
  return {};
}

}  // namespace regrasp
