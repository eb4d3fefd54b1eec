#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/sets/contour/region_diagram.h"

namespace regrasp::contour {

/// A grasp of two contacts as a point of contact space.
struct PlacedGrasp {
  PieceIndex piece;
  Eigen::Vector2d places = Eigen::Vector2d::Zero();  ///< on the piece's edges, as Boundary has them

  friend bool operator==(const PlacedGrasp&, const PlacedGrasp&) = default;
};

/// The geometry of a graph's sets, made when first asked for.
class SetGeometry {
 public:
  /// @param graph  outlives this object.
  /// @param deadline  when whatever asks for geometry makes an end, by TimeUp.
  explicit SetGeometry(const ContourGraph& graph, Deadline deadline = {})
      : graph_(graph), deadline_(std::move(deadline)) {}

  [[nodiscard]] const ContourGraph& graph() const { return graph_; }

  [[nodiscard]] const std::vector<Eigen::Vector2d>& OutlineOf(PieceIndex piece);
  [[nodiscard]] const RegionMetric& MetricOf(sets::SetIndex set);
  [[nodiscard]] const std::vector<DiagramEdge>& DiagramOf(sets::SetIndex set);

  /// Half-width of the largest square in a set.
  [[nodiscard]] double WidthOf(sets::SetIndex set);
  /// Half-width of the largest square about a grasp that lies in its set.
  [[nodiscard]] double SizeAt(const PlacedGrasp& grasp);

  /// How far the line through the contacts is inside both friction cones, radians; negative
  /// outside.
  [[nodiscard]] double AngleMarginOf(const PlacedGrasp& grasp) const;

  /// The places of the contact on the k-th edge that a piece's grasps have, and for one of them the
  /// places of the other contact; nullopt where doubles know none.
  [[nodiscard]] std::optional<PlaceRange> RangeOf(PieceIndex piece, int k);
  [[nodiscard]] std::optional<PlaceRange> SliceOf(PieceIndex piece, int k, double place);

  /// A grasp anywhere in a set, evenly by lengths; nullopt where it is too thin for doubles.
  [[nodiscard]] std::optional<PlacedGrasp> Draw(sets::SetIndex set, RandomStream& random);

  /// The point of contact space of a grasp whose contacts know their edges; nullopt where the exact
  /// decision knows no such grasp.
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

}  // namespace regrasp::contour
