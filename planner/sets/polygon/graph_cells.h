#pragma once

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

}  // namespace regrasp::polygon
