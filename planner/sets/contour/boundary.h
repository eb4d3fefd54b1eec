#pragma once

#include <vector>

#include "planner/base/index.h"
#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"

namespace regrasp::contour {

/// A ring of a polygon: the outline, 0, or a hole.
using RingIndex = Index<struct RingTag>;

/// The boundary of a polygon by its length: a place on a ring is the length of the ring from its
/// first vertex to there, along its edges (material on the left), periodic in the ring's perimeter.
/// Lengths are the object's own units.
class Boundary {
 public:
  /// `polygon` must outlive this object.
  explicit Boundary(const object::Polygon& polygon);

  [[nodiscard]] const object::Polygon& polygon() const { return polygon_; }

  [[nodiscard]] int edge_count() const { return static_cast<int>(ring_of_.size()); }
  [[nodiscard]] int ring_count() const { return static_cast<int>(perimeters_.size()); }
  [[nodiscard]] RingIndex ring_of(FaceIndex edge) const { return ring_of_[edge]; }
  /// The edges of a ring are first_edge(ring) to end_edge(ring), which is not among them.
  [[nodiscard]] FaceIndex first_edge(RingIndex ring) const { return first_edges_[ring]; }
  [[nodiscard]] FaceIndex end_edge(RingIndex ring) const { return first_edges_[ring + 1]; }
  [[nodiscard]] double perimeter(RingIndex ring) const { return perimeters_[ring]; }

  /// The edge that begins where this one ends.
  [[nodiscard]] FaceIndex next(FaceIndex edge) const { return next_[edge]; }

  /// Where an edge begins and ends on its ring; end > begin.
  [[nodiscard]] double begin(FaceIndex edge) const { return begins_[edge]; }
  [[nodiscard]] double end(FaceIndex edge) const { return ends_[edge]; }

  /// The place of a contact that knows its edge.
  [[nodiscard]] double PlaceOf(const grasp::Contact& contact) const;

  /// The contact on an edge at a place within begin(edge) to end(edge); rounding is cut off.
  [[nodiscard]] grasp::Contact ContactAt(FaceIndex edge, double place) const;

 private:
  const object::Polygon& polygon_;
  std::vector<RingIndex> ring_of_;
  std::vector<FaceIndex> first_edges_;
  std::vector<double> perimeters_;
  std::vector<FaceIndex> next_;
  std::vector<double> begins_;
  std::vector<double> ends_;
};

}  // namespace regrasp::contour
