#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// A set with its cells, as a search for a switch sees it.
struct SwitchSide {
  const GraspSet* set = nullptr;
  const SetCells* cells = nullptr;
  /// The contacts' parameters, where the grasp is given already.
  std::optional<Eigen::VectorXd> fixed;
};

/// Two grasps that a hand can switch between: the contacts on `kept` edges are the same.
struct SwitchPoint {
  Eigen::VectorXd before;       ///< parameters of the first set's contacts
  Eigen::VectorXd after;        ///< of the second's
  std::vector<FaceIndex> kept;  ///< edges, ascending
  double slack = 0;             ///< the smaller of both grasps', see GraspCell
};

/// The switch of largest slack for every pair of cells and every choice of contacts that stay, as
/// many as a hand of `fingers` fingers needs to keep or more. Empty where no switch has slack.
[[nodiscard]] std::vector<SwitchPoint> FindSwitchPoints(const SwitchSide& from,
                                                        const SwitchSide& to, int fingers);

/// How good a grasp of one of the two sides is, the more the better.
using GraspScore = std::function<double(const GraspSet& set, const Eigen::VectorXd& parameters)>;

/// The smaller score of a switch's two grasps, without those that are fixed: they are in the
/// sequence whatever is chosen. Infinite where both are.
[[nodiscard]] double ScoreOf(const SwitchSide& from, const SwitchSide& to, const SwitchPoint& point,
                             const GraspScore& score);

/// Moves the contacts of a switch to raise its score, by compass search (Kolda, Lewis and Torczon
/// 2003) with steps from a tenth of D down; both grasps stay in their sets with a quarter of the
/// slack, and contacts that are kept move together. Never lowers the score.
[[nodiscard]] SwitchPoint ImproveSwitch(const SwitchSide& from, const SwitchSide& to,
                                        const SwitchPoint& point, const GraspScore& score);

}  // namespace regrasp::polygon
