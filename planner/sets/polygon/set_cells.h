#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/grasp/edge_contact.h"
#include "planner/object/polygon.h"
#include "planner/sets/passage_search.h"
#include "planner/sets/polygon/grasp_set.h"
#include "planner/sets/polygon/slack_program.h"

namespace regrasp::polygon {

/// A convex set of grasps, given by linear inequalities. The variables are the contacts' parameters
/// (0 to 1 along their edges), one for each edge of the set in its order, and after them, of a
/// concurrent set, the focus point about the centroid over D. Slacks are lengths over D: the focus
/// point's or the contact's distance to the border of a cone, a contact's distance to the ends of
/// its edge. Straight lines between points of a cell are aligns that stay inside it.
struct GraspCell {
  int part = 0;  ///< of the set, see GraspSet::parts
  Inequalities inequalities;
  SlackSolution centre;  ///< of largest slack
};

/// A grasp set as cells, all with an interior.
class SetCells {
 public:
  /// In doubles: existence was decided when the set was found, and what is too thin for doubles is
  /// left out here. Polygon and set must outlive the cells.
  SetCells(const object::Polygon& polygon, const GraspSet& set);

  [[nodiscard]] const std::vector<GraspCell>& cells() const { return cells_; }

  /// The grasp of largest slack where an align can pass from one cell to another: in what the cells
  /// have in common, or with the focus point on the edge that parts them.
  /// @returns its contacts' parameters; nullopt where the cells don't meet.
  [[nodiscard]] std::optional<Eigen::VectorXd> Passage(sets::PieceIndex from,
                                                       sets::PieceIndex to) const;

  /// The largest slack of a grasp in the set.
  [[nodiscard]] double width() const;

  /// The length of the set's k-th edge over D.
  [[nodiscard]] double edge_length(int k) const {
    return polygon_.face_measure(set_.edges[k]) / polygon_.diameter();
  }

 private:
  const object::Polygon& polygon_;
  const GraspSet& set_;
  std::vector<GraspCell> cells_;
};

/// The largest slack of a parallel set's grasps whose outer contacts are on different sides of the
/// whole common cone; 0 where there are none. Two linear programs a centre instead of eight.
[[nodiscard]] double ClearWidth(const object::Polygon& polygon, const GraspSet& parallel);

/// Slacks up to this, over D, count as none: a few hundred roundings of the inequalities.
inline constexpr double kNoSlack = 1e-12;

/// The slack of a grasp in a cell, with the best focus point where there is one.
/// @param parameters  of the contacts, in the order of the set's edges.
[[nodiscard]] double SlackInCell(const GraspCell& cell, const Eigen::VectorXd& parameters);

/// True iff a grasp has more than `slack` in one of the cells.
[[nodiscard]] bool IsInSet(const SetCells& set, const Eigen::VectorXd& parameters,
                           double slack = kNoSlack);

}  // namespace regrasp::polygon
