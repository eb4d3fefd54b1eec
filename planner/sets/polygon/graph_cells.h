#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/sets/grasp_set_model.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// Grasp of a set: parameters of its contacts, in the order of the set's edges.
struct PolygonPlace {
  sets::SetIndex set;
  Eigen::VectorXd parameters;
};

/// Cells of a graph's sets, computed on first use.
class GraphCells {
 public:
  /// @param polygon, graph  must outlive this object.
  /// @param deadline  deadline after which every function throws TimeUp.
  GraphCells(const object::Polygon& polygon, const PolygonGraph& graph, Deadline deadline = {})
      : polygon_(polygon),
        graph_(graph),
        deadline_(std::move(deadline)),
        cells_(graph.sets().size()),
        widths_(graph.sets().size()) {}

  [[nodiscard]] const SetCells& of(sets::SetIndex set);

  /// Return the largest slack of a grasp in the set; for a parallel set the cheaper ClearWidth.
  [[nodiscard]] double WidthOf(sets::SetIndex set);

  /// Find the sets that contain the grasp, or two or three of its contacts. Sets with more contacts
  /// come first.
  [[nodiscard]] std::vector<sets::Attachment<PolygonPlace>> FindAttachments(
      const grasp::Grasp& grasp);

  /// Find grasps that a hand reaches by a switch that also places fingers.
  ///
  /// For each set and each choice of kept contacts, the result contains the grasp with the largest
  /// slack. It serves grasps that belong to no set.
  /// @param fingers  number of fingers of the hand.
  [[nodiscard]] std::vector<sets::Attachment<PolygonPlace>> FindSwitches(const grasp::Grasp& grasp,
                                                                         int fingers);

  /// Draw a random grasp of the set; nullopt if it is too thin for doubles.
  [[nodiscard]] std::optional<PolygonPlace> Draw(sets::SetIndex set, RandomStream& random);

  [[nodiscard]] grasp::Grasp GraspOf(const PolygonPlace& place) const;

 private:
  const object::Polygon& polygon_;
  const PolygonGraph& graph_;
  Deadline deadline_;
  std::vector<std::optional<SetCells>> cells_;
  std::vector<std::optional<double>> widths_;
};

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
