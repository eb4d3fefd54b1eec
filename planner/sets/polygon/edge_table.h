#pragma once

#include <array>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/plane.h"

namespace regrasp::polygon {

/// The edges of a polygon as exact predicates see them. Made inside an IntervalScope.
class EdgeTable {
 public:
  /// @param tangent  tan θ of the friction half-angle.
  EdgeTable(const object::Polygon& polygon, double tangent);

  /// The table of some of the edges, as though the polygon had no others.
  /// @param edges  ascending; they get the numbers 0, 1, …
  [[nodiscard]] EdgeTable Of(const std::vector<FaceIndex>& edges) const;

  [[nodiscard]] int size() const { return static_cast<int>(ends_.size()); }
  [[nodiscard]] double tangent() const { return tangent_; }
  [[nodiscard]] const EdgeEnds& ends(FaceIndex edge) const { return ends_[edge]; }
  /// The polygon's vertices, numbered over all rings, at which an edge begins and ends.
  [[nodiscard]] const std::array<int, 2>& vertices(FaceIndex edge) const { return vertices_[edge]; }

  /// An edge with cones of half-angle θ, or of another half-angle.
  template <class NT>
  [[nodiscard]] EdgeFrame<NT> frame(FaceIndex edge, double tangent) const {
    if constexpr (std::is_same_v<NT, Interval>) {
      if (tangent == tangent_) return frames_[edge];
    }
    return MakeEdgeFrame<NT>(ends_[edge], tangent);
  }
  template <class NT>
  [[nodiscard]] EdgeFrame<NT> frame(FaceIndex edge) const {
    return frame<NT>(edge, tangent_);
  }

 private:
  explicit EdgeTable(double tangent) : tangent_(tangent) {}

  double tangent_;
  std::vector<EdgeEnds> ends_;
  std::vector<std::array<int, 2>> vertices_;
  std::vector<EdgeFrame<Interval>> frames_;  ///< at tangent_
};

}  // namespace regrasp::polygon
