#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/sets/grasp_set_model.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// A grasp of a set, by the parameters of its contacts in the order of the set's edges.
struct PolygonPlace {
  sets::SetIndex set;
  Eigen::VectorXd parameters;
};

/// The cells of a graph's sets, made when first asked for.
class GraphCells {
 public:
  /// @param deadline  when whatever asks for cells makes an end, by TimeUp.
  GraphCells(const object::Polygon& polygon, const PolygonGraph& graph, Deadline deadline = {})
      : polygon_(polygon),
        graph_(graph),
        deadline_(std::move(deadline)),
        cells_(graph.sets().size()),
        widths_(graph.sets().size()) {}

  [[nodiscard]] const SetCells& of(sets::SetIndex set);

  /// The largest slack of a grasp in the set; of a parallel one ClearWidth, which is cheaper.
  [[nodiscard]] double WidthOf(sets::SetIndex set);

  /// The sets that contain the grasp, or two or three of its contacts; those with more contacts
  /// first.
  [[nodiscard]] std::vector<sets::Attachment<PolygonPlace>> FindAttachments(
      const grasp::Grasp& grasp);

  /// The grasps of sets that a hand of `fingers` fingers comes to by placing fingers too: of each
  /// set and each choice of contacts that stay, the one with the most slack. For grasps that belong
  /// to no set.
  [[nodiscard]] std::vector<sets::Attachment<PolygonPlace>> FindSwitches(const grasp::Grasp& grasp,
                                                                         int fingers);

  /// A grasp of the set, anywhere in it; nullopt where it is too thin for doubles.
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
