#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/polygon/polygon_graph.h"
#include "planner/polygon/set_cells.h"

namespace regrasp {

/// How a grasp belongs to a vertex of the graph.
struct Attachment {
  int vertex = 0;
  std::vector<int> contacts;   ///< of the grasp, in the order of the set's edges
  Eigen::VectorXd parameters;  ///< of these contacts
};

/// The cells of a graph's sets, made when first asked for.
class GraphCells {
 public:
  GraphCells(const Polygon& polygon, const PolygonGraph& graph)
      : polygon_(polygon), graph_(graph), cells_(graph.sets().size()) {}

  [[nodiscard]] const SetCells& of(int vertex);

  /// The sets that contain the grasp, or two or three of its contacts; those with more contacts
  /// first.
  [[nodiscard]] std::vector<Attachment> FindAttachments(const Grasp& grasp);

  /// A grasp of the set, anywhere in it.
  [[nodiscard]] Grasp DrawGrasp(int vertex, RandomStream& random);

 private:
  const Polygon& polygon_;
  const PolygonGraph& graph_;
  std::vector<std::optional<SetCells>> cells_;
};

}  // namespace regrasp
