#pragma once

#include <vector>

#include "planner/base/index.h"
#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"

namespace regrasp::contour {

/// Index of a ring of a polygon: 0 for the outline, otherwise a hole.
using RingIndex = Index<struct RingTag>;

/// Parametrization of a polygon's boundary by length.
///
/// A place on a ring is the length along the ring's edges (material on the left) from its first
/// vertex. It is periodic in the ring's perimeter. Lengths are in object units.
class Boundary {
 public:
  /// @param polygon  must outlive this object.
  explicit Boundary(const object::Polygon& polygon);

  [[nodiscard]] const object::Polygon& polygon() const { return polygon_; }

  [[nodiscard]] int edge_count() const { return static_cast<int>(ring_of_.size()); }
  [[nodiscard]] int ring_count() const { return static_cast<int>(perimeters_.size()); }
  [[nodiscard]] RingIndex ring_of(FaceIndex edge) const { return ring_of_[edge]; }
  /// Range of the edges of a ring: first_edge(ring), inclusive, to end_edge(ring), exclusive.
  [[nodiscard]] FaceIndex first_edge(RingIndex ring) const { return first_edges_[ring]; }
  [[nodiscard]] FaceIndex end_edge(RingIndex ring) const { return first_edges_[ring + 1]; }
  [[nodiscard]] double perimeter(RingIndex ring) const { return perimeters_[ring]; }

  /// Edge that starts at the end of this one.
  [[nodiscard]] FaceIndex next(FaceIndex edge) const { return next_[edge]; }

  /// Places of the start and the end of an edge on its ring; end > begin.
  [[nodiscard]] double begin(FaceIndex edge) const { return begins_[edge]; }
  [[nodiscard]] double end(FaceIndex edge) const { return ends_[edge]; }

  /// Return the place of a contact whose face is set.
  [[nodiscard]] double PlaceOf(const grasp::Contact& contact) const;

  /// Return the contact on an edge at a place, which is clamped to begin(edge) … end(edge).
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
