#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/sets/candidate_search.h"
#include "planner/sets/grasp_set_model.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace regrasp::polyhedron {

/// Concurrent grasp in a cell.
struct FocusGrasp {
  sets::SetIndex cell;
  sets::PieceIndex piece;  ///< piece of the cell
  /// Point that sees all contacts inside their cones.
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();
  /// Contacts in the order of the cell's faces.
  std::array<Eigen::Vector3d, 4> points = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                           Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// Model of the focus cells of a solid's switching graph (GraspSetModel).
///
/// In a piece, focus point and contacts together form a convex set. A simultaneous straight motion
/// of all of them between two grasps of the piece therefore stays in the piece.
class PolyhedronModel : public sets::EvaluatedModel<FocusGrasp> {
 public:
  /// @param solid, graph  must outlive this object.
  PolyhedronModel(const object::Polyhedron& solid, PolyhedronGraph& graph,
                  const planning::PlanRequest& request)
      : EvaluatedModel(request), solid_(solid), graph_(graph) {}

  [[nodiscard]] const PolyhedronGraph& graph() const { return graph_; }
  [[nodiscard]] static std::string sets_name() { return "focus cells"; }
  /// Return the depth of the deepest focus point of a cell inside the volumes of its faces, a
  /// length.
  [[nodiscard]] double WidthOf(sets::SetIndex cell);
  [[nodiscard]] std::optional<Place> Draw(sets::SetIndex cell, RandomStream& random);
  [[nodiscard]] grasp::Grasp GraspOf(const Place& place) const;

  /// Find the cells of a grasp, each with the focus point deepest inside the contacts' cones.
  /// @param grasp  four contacts whose faces are set.
  [[nodiscard]] Attachments Attach(const grasp::Grasp& grasp);
  [[nodiscard]] std::string WhyUnattached(const grasp::Grasp& grasp) const;

  /// Find the switch with the focus point deepest inside the volumes of all five faces.
  [[nodiscard]] std::optional<Switch> FindSwitch(const Ends& ends);
  /// Find the waypoints of a sliding step: straight inside pieces, through as few junctions as
  /// possible.
  [[nodiscard]] std::vector<Place> FindRoute(const Place& from, const Place& to);

 private:
  /// Given contacts of a grasp, in the order of a cell's faces.
  using GivenContacts = std::array<std::optional<Eigen::Vector3d>, 4>;

  [[nodiscard]] std::optional<Place> FindDeepest(sets::SetIndex cell,
                                                 const GivenContacts& contacts);
  [[nodiscard]] std::optional<MinMaxResult> FindDeepestFocus(const FocusCell& cell,
                                                             const FocusPiece& piece,
                                                             const GivenContacts& contacts);
  [[nodiscard]] std::optional<Place> Complete(const Place& given, sets::SetIndex cell);
  [[nodiscard]] int CountCommonContacts(const Place& a, const Place& b) const;
  [[nodiscard]] std::optional<Switch> FindDeepestSwitch(sets::SetIndex from, sets::SetIndex to);
  void PlaceContacts(Switch& change) const;
  [[nodiscard]] Eigen::Vector3d DrawFocus(const FocusCell& cell, const FocusPiece& piece,
                                          RandomStream& random) const;

  const object::Polyhedron& solid_;
  PolyhedronGraph& graph_;
  std::map<sets::SetIndex, double> widths_;
};

}  // namespace regrasp::polyhedron
