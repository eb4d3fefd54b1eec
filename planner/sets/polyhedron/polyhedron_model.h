#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/sets/grasp_set_model.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace regrasp::polyhedron {

/// A concurrent grasp of a cell.
struct FocusGrasp {
  int cell = 0;
  int piece = 0;                                    ///< of the cell
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();  ///< sees all contacts inside their cones
  /// Contacts, by the cell's faces.
  std::array<Eigen::Vector3d, 4> points = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                           Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// The focus cells of a solid's switching graph, as planning over sets sees them.
///
/// In a piece, focus point and contacts together form a convex set: any straight motion of all of
/// them between two of its grasps is a motion through its grasps.
class PolyhedronModel {
 public:
  using Place = FocusGrasp;

  /// Both outlive this object.
  PolyhedronModel(const object::Polyhedron& solid, PolyhedronGraph& graph)
      : solid_(solid), graph_(graph) {}

  [[nodiscard]] const PolyhedronGraph& graph() const { return graph_; }
  [[nodiscard]] static std::string sets_name() { return "focus cells"; }
  /// How deep the deepest focus point of a cell is inside the volumes of its faces, a length.
  [[nodiscard]] double WidthOf(int cell);
  [[nodiscard]] std::optional<Place> Draw(int cell, RandomStream& random);
  [[nodiscard]] grasp::Grasp GraspOf(const Place& place) const;

  /// Each with the focus point deepest inside the contacts' cones.
  /// @param grasp  four contacts that know their faces.
  [[nodiscard]] std::vector<sets::Attachment<Place>> Attach(
      const grasp::Grasp& grasp, const criteria::GraspEvaluator& evaluator);
  [[nodiscard]] std::string WhyUnattached(const grasp::Grasp& grasp) const;

  /// Where the focus point is deepest inside the volumes of all five faces.
  [[nodiscard]] std::optional<sets::SetSwitch<Place>> FindSwitch(
      int from, int to, const sets::SwitchEnds<Place>& ends,
      const criteria::GraspEvaluator& evaluator);
  /// Straight inside pieces, from piece to piece through their junctions, fewest first.
  [[nodiscard]] std::vector<Place> FindRoute(const Place& from, const Place& to);

 private:
  /// The contacts of a grasp that are given, by a cell's faces.
  using GivenContacts = std::array<std::optional<Eigen::Vector3d>, 4>;

  [[nodiscard]] std::optional<Place> FindDeepest(int cell, const GivenContacts& contacts);
  [[nodiscard]] std::optional<MinMaxResult> FindDeepestFocus(const FocusCell& cell,
                                                             const FocusPiece& piece,
                                                             const GivenContacts& contacts);
  [[nodiscard]] std::optional<Place> Complete(const Place& given, int cell);
  [[nodiscard]] int CountCommonContacts(const Place& a, const Place& b) const;
  [[nodiscard]] std::optional<sets::SetSwitch<Place>> FindDeepestSwitch(int from, int to);
  void PlaceContacts(sets::SetSwitch<Place>& change) const;
  [[nodiscard]] Eigen::Vector3d DrawFocus(const FocusCell& cell, const FocusPiece& piece,
                                          RandomStream& random) const;

  const object::Polyhedron& solid_;
  PolyhedronGraph& graph_;
  std::map<int, double> widths_;
};

}  // namespace regrasp::polyhedron
