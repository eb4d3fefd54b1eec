#pragma once

#include <vector>

#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// The contacts' parameters that an align passes from one grasp of a set to another, both ends
/// included: straight lines inside cells, through passages where it leaves one. Fewest passages
/// first. On a straight line all contacts move at the same rate, and every grasp on it is in the
/// set.
/// @returns an empty vector where no chain of cells that doubles can tell joins the two.
[[nodiscard]] std::vector<Eigen::VectorXd> FindAlignPath(const SetCells& set,
                                                         const Eigen::VectorXd& from,
                                                         const Eigen::VectorXd& to);

}  // namespace regrasp::polygon
