#include "planner/sets/polygon/align_path.h"

#include "planner/sets/passage_search.h"

namespace regrasp::polygon {

using Eigen::VectorXd;

namespace {

std::vector<bool> CellsWith(const SetCells& set, const VectorXd& parameters) {
  std::vector<bool> contain;
  for (const GraspCell& cell : set.cells()) {
    contain.push_back(SlackInCell(cell, parameters) > kNoSlack);
  }
  return contain;
}

}  // namespace

std::vector<VectorXd> FindAlignPath(const SetCells& set, const VectorXd& from, const VectorXd& to) {
  const auto passages = sets::FindPassages<VectorXd>(
      CellsWith(set, from), CellsWith(set, to),
      [&](sets::PieceIndex cell, sets::PieceIndex next) { return set.Passage(cell, next); });
  if (!passages) return {};
  std::vector<VectorXd> path = {from};
  path.insert(path.end(), passages->begin(), passages->end());
  path.push_back(to);
  return path;
}

}  // namespace regrasp::polygon
