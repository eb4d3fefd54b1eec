#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// One set of a switch, with its cells.
struct SwitchSide {
  const GraspSet* set = nullptr;
  const SetCells* cells = nullptr;
  /// Contact parameters, if the grasp is given.
  std::optional<Eigen::VectorXd> fixed;
};

/// Finger switch between two grasps. The contacts on `kept` edges are equal.
struct SwitchPoint {
  Eigen::VectorXd before;       ///< contact parameters in the first set
  Eigen::VectorXd after;        ///< contact parameters in the second set
  std::vector<FaceIndex> kept;  ///< edges of kept contacts, ascending
  double slack = 0;             ///< smaller slack of the two grasps (GraspCell)
};

/// Find the switch of largest slack for every pair of cells and every choice of kept contacts.
///
/// A choice keeps at least as many contacts as a hand of `fingers` fingers requires. The result is
/// empty if no switch has slack.
[[nodiscard]] std::vector<SwitchPoint> FindSwitchPoints(const SwitchSide& from,
                                                        const SwitchSide& to, int fingers);

/// Score of a grasp of one of the two sets; higher is better.
using GraspScore = std::function<double(const GraspSet& set, const Eigen::VectorXd& parameters)>;

/// Return the smaller score of a switch's two grasps. Given grasps are ignored, because the
/// sequence contains them anyway. Infinite if both are given.
[[nodiscard]] double ScoreOf(const SwitchSide& from, const SwitchSide& to, const SwitchPoint& point,
                             const GraspScore& score);

/// Move the contacts of a switch to raise its score.
///
/// The method is compass search (Kolda, Lewis and Torczon 2003) with steps from D/10 downward. Both
/// grasps stay in their sets with a quarter of the slack, and kept contacts stay equal. Law: the
/// score never decreases.
[[nodiscard]] SwitchPoint ImproveSwitch(const SwitchSide& from, const SwitchSide& to,
                                        const SwitchPoint& point, const GraspScore& score);

}  // namespace regrasp::polygon
