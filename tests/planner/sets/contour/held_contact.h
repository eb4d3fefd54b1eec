#pragma once

#include <optional>

#include "planner/sets/contour/set_geometry.h"

namespace regrasp::contour {

/// An open interval of places.
struct Section {
  double low;
  double high;
};

/// Where an outline is met by the line on which the k-th place is `at`.
[[nodiscard]] std::optional<Section> SectionOf(const std::vector<Eigen::Vector2d>& outline, int k,
                                               double at);

/// The half-width on a diagram's edge, by the share of its length from its one end.
[[nodiscard]] double SizeOn(const DiagramEdge& edge, double share);

/// The grasps of a set with one contact held at a place of an edge, whichever finger it belongs to.
class HeldContact {
 public:
  /// `geometry` must outlive this object.
  HeldContact(SetGeometry& geometry, sets::SetIndex set, FaceIndex edge, double at)
      : geometry_(geometry), set_(set), edge_(edge), at_(at) {}

  /// The largest half-width of samples of every piece, and how far apart these are: sizes change by
  /// no more than the distance between two grasps.
  struct Sampled {
    double best = 0;
    double spacing = 0;
  };
  [[nodiscard]] Sampled Sample(int samples) const;

  /// The largest half-width on the set's diagram.
  [[nodiscard]] double ByDiagram() const;

 private:
  SetGeometry& geometry_;
  sets::SetIndex set_;
  FaceIndex edge_;
  double at_;
};

}  // namespace regrasp::contour
