#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/sets/grasp_set_model.h"
#include "planner/sets/polyhedron/focus_geometry.h"

namespace regrasp::polyhedron {

/// The focus cells of a solid's switching graph, as planning over sets sees them.
class PolyhedronModel {
 public:
  using Place = FocusGrasp;

  /// Both outlive this object.
  PolyhedronModel(const object::Polyhedron& solid, PolyhedronGraph& graph)
      : geometry_(solid, graph) {}

  [[nodiscard]] const PolyhedronGraph& graph() const { return geometry_.graph(); }
  [[nodiscard]] search::Components components() const { return graph().components(); }
  [[nodiscard]] static std::string sets_name() { return "focus cells"; }
  [[nodiscard]] double WidthOf(int cell) { return geometry_.WidthOf(cell); }
  [[nodiscard]] grasp::Grasp Draw(int cell, RandomStream& random);

  [[nodiscard]] static int SetOf(const Place& place) { return place.cell; }
  [[nodiscard]] grasp::Grasp GraspOf(const Place& place) const { return geometry_.GraspOf(place); }
  [[nodiscard]] std::vector<Attachment<Place>> Attach(const grasp::Grasp& grasp,
                                                      const criteria::GraspEvaluator& evaluator);
  [[nodiscard]] std::string WhyUnattached(const grasp::Grasp& grasp) const;

  /// Where the focus point is deepest inside the volumes of all five faces.
  [[nodiscard]] std::optional<SetSwitch<Place>> FindSwitch(
      int from, int to, const SwitchEnds<Place>& ends, const criteria::GraspEvaluator& evaluator);
  [[nodiscard]] std::vector<Place> FindRoute(const Place& from, const Place& to);

 private:
  FocusGeometry geometry_;
};

}  // namespace regrasp::polyhedron
