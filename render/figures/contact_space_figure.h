#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/plan/plan.h"
#include "planner/sets/contour/set_geometry.h"
#include "render/figures/contact_space_map.h"
#include "render/figures/contact_space_track.h"
#include "render/figures/panel_sheet.h"

namespace regrasp::render {

/// Figures of a plan of 2-finger grasps in contact space: an overview, and one figure per switch.
///
/// Plans of any planner are accepted.
class ContactSpaceFigures {
 public:
  /// Prepare the figures of a plan.
  /// @param polygon, plan  object, and a plan that is located on it and valid. Every static grasp
  ///                 has two contacts (FindOtherThanTwoContacts). Both must outlive this object.
  ContactSpaceFigures(const object::Polygon& polygon, const plan::Plan& plan);
  ContactSpaceFigures(const ContactSpaceFigures&) = delete;
  ContactSpaceFigures& operator=(const ContactSpaceFigures&) = delete;

  [[nodiscard]] std::string DrawOverview(const FigureStyle& style);

  /// Draw a switch.
  /// @param entry  index of the entry: k for the k-th step.
  /// @returns the bytes of the file; nullopt if the step is not a switch that keeps a contact, or
  ///          if one of its grasps is on the border of force closure and in no set.
  [[nodiscard]] std::optional<std::string> DrawSwitch(plan::EntryIndex entry,
                                                      const FigureStyle& style);

 private:
  const plan::Plan& plan_;
  contour::ContourGraph graph_;
  contour::SetGeometry geometry_;
  std::vector<TrackEntry> track_;
  std::map<sets::SetIndex, int> names_;
  AxisUnit unit_;
};

/// Draw the contact space of the rings that a plan uses, with the plan (Phoka 2010, figures 4.3,
/// 4.4 and 4.8).
///
/// The axes are the boundary lengths of the first contact (right) and of the second (up). Both
/// halves of the symmetric space are drawn. Sets of the plan are coloured and have their names at
/// the centres of their largest squares. Other sets are grey, and stretching grasps are hatched.
/// Static grasps are numbered dots: 0 the initial one, k that after step k. Sliding steps are lines
/// that end at the frame, and switches are dashed lines along one axis. Several rings are drawn in
/// one grid. Small rings have their own scale.
///
/// The figure is one column wide, or two for several rings or many edges. Deterministic.
/// @returns the bytes of the file.
/// @throws EnvironmentError  if Cairo fails.
[[nodiscard]] std::string DrawContactSpace(const contour::Boundary& boundary,
                                           const ContactSpaceMap& map, const AxisUnit& unit,
                                           const std::string& caption, const FigureStyle& style);

}  // namespace regrasp::render
