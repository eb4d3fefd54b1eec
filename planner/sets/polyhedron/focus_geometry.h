#pragma once

#include <map>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/grasp/contact.h"
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

/// A common grasp of two cells but for one contact: what a finger switch goes between.
using FocusSwitch = SetSwitch<FocusGrasp>;

/// Chooses focus points and contacts in the cells of a graph.
///
/// In a piece, focus point and contacts together form a convex set: any straight motion of all of
/// them between two of its grasps is a motion through its grasps.
class FocusGeometry {
 public:
  /// Both must outlive this object.
  FocusGeometry(const object::Polyhedron& solid, PolyhedronGraph& graph)
      : solid_(solid), graph_(graph) {}

  [[nodiscard]] const PolyhedronGraph& graph() const { return graph_; }
  [[nodiscard]] grasp::Grasp GraspOf(const FocusGrasp& grasp) const;

  /// How deep the deepest focus point of a cell is inside the volumes of its faces, a length.
  [[nodiscard]] double WidthOf(int cell);

  /// The cells that a grasp of four contacts, which know their faces, belongs to, each with the
  /// focus point deepest inside the contacts' cones.
  [[nodiscard]] std::vector<FocusGrasp> Locate(const grasp::Grasp& grasp);

  /// The switch between two linked cells whose focus point is deepest inside all five volumes.
  [[nodiscard]] std::optional<FocusSwitch> FindSwitch(int from, int to);
  /// One that starts from a given grasp and keeps its contacts, or ends in one.
  [[nodiscard]] std::optional<FocusSwitch> FindSwitchFrom(const FocusGrasp& before, int to);
  [[nodiscard]] std::optional<FocusSwitch> FindSwitchTo(int from, const FocusGrasp& after);
  /// The one between two given grasps; nullopt where they have not three contacts in common.
  [[nodiscard]] std::optional<FocusSwitch> FindSwitchBetween(const FocusGrasp& before,
                                                             const FocusGrasp& after) const;

  /// The grasps that an align passes, both ends included: straight inside pieces, from piece to
  /// piece through their junctions, fewest first.
  [[nodiscard]] std::vector<FocusGrasp> FindRoute(const FocusGrasp& from, const FocusGrasp& to);

  /// A grasp anywhere in a cell; nullopt where none is found.
  [[nodiscard]] std::optional<FocusGrasp> Draw(int cell, RandomStream& random);

 private:
  [[nodiscard]] std::optional<FocusGrasp> Complete(const FocusGrasp& given, int cell);
  [[nodiscard]] Eigen::Vector3d ContactFor(int half, double tangent,
                                           const Eigen::Vector3d& focus) const;
  [[nodiscard]] bool ContainsContact(int half, const Eigen::Vector3d& contact) const;

  const object::Polyhedron& solid_;
  PolyhedronGraph& graph_;
  std::map<int, double> widths_;
};

}  // namespace regrasp::polyhedron
