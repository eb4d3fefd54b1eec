#include "planner/sets/polygon/edge_table.h"

namespace regrasp::polygon {

EdgeTable::EdgeTable(const object::Polygon& polygon, double tangent) : tangent_(tangent) {
  int first = 0;
  for (const auto& ring : polygon.rings()) {
    const int n = static_cast<int>(ring.size());
    for (int k = 0; k < n; ++k) {
      const Eigen::Vector2d& a = ring[k];
      const Eigen::Vector2d& b = ring[(k + 1) % n];
      ends_.push_back({{a.x(), a.y()}, {b.x(), b.y()}});
      vertices_.push_back({first + k, first + (k + 1) % n});
      frames_.push_back(MakeEdgeFrame<Interval>(ends_.back(), tangent));
    }
    first += n;
  }
}

EdgeTable EdgeTable::Of(const std::vector<FaceIndex>& edges) const {
  EdgeTable table(tangent_);
  for (const FaceIndex edge : edges) {
    table.ends_.push_back(ends_[edge]);
    table.vertices_.push_back(vertices_[edge]);
    table.frames_.push_back(frames_[edge]);
  }
  return table;
}

}  // namespace regrasp::polygon
