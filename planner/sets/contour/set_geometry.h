#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/sets/contour/region_diagram.h"

namespace regrasp::contour {

/// A 2-finger grasp as a point of contact space.
struct PlacedGrasp {
  PieceIndex piece;
  Eigen::Vector2d places = Eigen::Vector2d::Zero();  ///< places on the piece's edges (Boundary)

  friend bool operator==(const PlacedGrasp&, const PlacedGrasp&) = default;
};

/// Geometry of a graph's sets, computed on first use.
class SetGeometry {
 public:
  /// @param graph  must outlive this object.
  /// @param deadline  deadline after which computations of geometry throw TimeUp.
  explicit SetGeometry(const ContourGraph& graph, Deadline deadline = {})
      : graph_(graph), deadline_(std::move(deadline)) {}

  [[nodiscard]] const ContourGraph& graph() const { return graph_; }

  [[nodiscard]] const std::vector<Eigen::Vector2d>& OutlineOf(PieceIndex piece);
  [[nodiscard]] const RegionMetric& MetricOf(sets::SetIndex set);
  [[nodiscard]] const std::vector<DiagramEdge>& DiagramOf(sets::SetIndex set);

  /// Return the half-width of the largest square in a set.
  [[nodiscard]] double WidthOf(sets::SetIndex set);
  /// Return the half-width of the largest square about a grasp that is inside its set.
  [[nodiscard]] double SizeAt(const PlacedGrasp& grasp);

  /// Return the angle by which the line through the contacts is inside both friction cones, rad;
  /// negative outside.
  [[nodiscard]] double AngleMarginOf(const PlacedGrasp& grasp) const;

  /// Return the places of the contact on the k-th edge in a piece; SliceOf returns those of the
  /// other contact for one such place. nullopt if doubles find none.
  [[nodiscard]] std::optional<PlaceRange> RangeOf(PieceIndex piece, int k);
  [[nodiscard]] std::optional<PlaceRange> SliceOf(PieceIndex piece, int k, double place);

  /// Draw a grasp of a set, uniformly by area of contact space; nullopt if it is too thin for
  /// doubles.
  [[nodiscard]] std::optional<PlacedGrasp> Draw(sets::SetIndex set, RandomStream& random);

  /// Return the point of contact space of a grasp whose faces are set; nullopt if, by the exact
  /// decision, there is no piece for it.
  [[nodiscard]] std::optional<PlacedGrasp> Locate(const grasp::Grasp& grasp) const;

  [[nodiscard]] grasp::Grasp GraspOf(const PlacedGrasp& grasp) const;

 private:
  struct Diagram {
    std::vector<DiagramEdge> edges;
    double width = 0;
  };
  [[nodiscard]] const Diagram& FindDiagram(sets::SetIndex set);

  const ContourGraph& graph_;
  Deadline deadline_;
  std::map<PieceIndex, std::vector<Eigen::Vector2d>> outlines_;
  std::map<sets::SetIndex, RegionMetric> metrics_;
  std::map<sets::SetIndex, Diagram> diagrams_;
};

/// Find the path of a sliding step inside a set, including both ends.
///
/// The path is straight in contact space inside one piece. If a contact passes a vertex of the
/// polygon, the path contains two grasps with the same contact points: one in the piece before the
/// vertex, one in the piece after it.
///
/// The path stays away from the border of the set. The width of a path is that of its narrowest
/// passage: the angle by which the line through the contacts is inside the friction cones.
/// Admissible paths are at least half as wide as the widest path. Among them the shortest one is
/// selected (Dijkstra 1959), with lengths divided by the margin. It is then straightened inside the
/// middle part of each passage.
/// @param from, to  two grasps of one set.
[[nodiscard]] std::vector<PlacedGrasp> FindAlignRoute(SetGeometry& geometry,
                                                      const PlacedGrasp& from,
                                                      const PlacedGrasp& to);

}  // namespace regrasp::contour
