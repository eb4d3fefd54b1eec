#pragma once

#include <optional>
#include <vector>

#include "planner/polygon/set_cells.h"

namespace regrasp {

/// A set with its cells, as a search for a switch sees it.
struct SwitchSide {
  const GraspSet* set = nullptr;
  const SetCells* cells = nullptr;
  /// The contacts' parameters, where the grasp is given already.
  std::optional<Eigen::VectorXd> fixed;
};

/// Two grasps that a hand can switch between: the contacts on `kept` edges are the same.
struct SwitchPoint {
  Eigen::VectorXd before;  ///< parameters of the first set's contacts
  Eigen::VectorXd after;   ///< of the second's
  std::vector<int> kept;   ///< edges of the polygon, ascending
  double slack = 0;        ///< the smaller of both grasps', see SetCell
};

/// The switch between two sets whose smaller slack is largest, over all cells and all contacts that
/// may stay: as many as a hand of `fingers` fingers needs to keep or more. Where it costs no more
/// than half of the slack, more contacts stay.
/// @returns nullopt where no switch has slack.
[[nodiscard]] std::optional<SwitchPoint> FindSwitchPoint(const SwitchSide& from,
                                                         const SwitchSide& to, int fingers);

}  // namespace regrasp
