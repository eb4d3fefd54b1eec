#pragma once

#include <optional>

#include "planner/sets/contour/set_geometry.h"

namespace regrasp::contour {

/// Open interval of places.
struct Section {
  double low;
  double high;
};

/// Return the intersection of an outline with the line on which the k-th place is `at`.
[[nodiscard]] std::optional<Section> SectionOf(const std::vector<Eigen::Vector2d>& outline, int k,
                                               double at);

/// Return the half-width at a fraction of a diagram edge.
[[nodiscard]] double SizeOn(const DiagramEdge& edge, double share);

/// Grasps of a set with one contact fixed at a place of an edge, for either finger.
class HeldContact {
 public:
  /// @param geometry  must outlive this object.
  HeldContact(SetGeometry& geometry, sets::SetIndex set, FaceIndex edge, double at)
      : geometry_(geometry), set_(set), edge_(edge), at_(at) {}

  /// Largest half-width of samples of every piece, and their spacing. The half-width changes at
  /// most by the distance between two grasps.
  struct Sampled {
    double best = 0;
    double spacing = 0;
  };
  [[nodiscard]] Sampled Sample(int samples) const;

  /// Return the largest half-width on the set's diagram.
  [[nodiscard]] double ByDiagram() const;

 private:
  SetGeometry& geometry_;
  sets::SetIndex set_;
  FaceIndex edge_;
  double at_;
};

}  // namespace regrasp::contour
