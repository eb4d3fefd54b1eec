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
#include "render/figures/figure_format.h"

namespace regrasp::render {

/// Figures of a plan of 2-finger grasps in contact space, as files' bytes, whichever planner made
/// it: the overview (contact_space_overview.h) and one of each switch
/// (contact_space_switch_page.h).
class ContactSpaceFigures {
 public:
  /// @param polygon, plan  located and legal; every grasp at rest has two contacts
  ///                       (FindOtherThanTwoFingers). Both must outlive this object.
  ContactSpaceFigures(const object::Polygon& polygon, const plan::Plan& plan);
  ContactSpaceFigures(const ContactSpaceFigures&) = delete;
  ContactSpaceFigures& operator=(const ContactSpaceFigures&) = delete;

  [[nodiscard]] std::string DrawOverview(FigureFormat format);

  /// @param entry  k for step k.
  /// @returns nullopt where the step is not a switch that keeps a contact, or one of its grasps is
  ///          in no set: at the very border of force closure.
  [[nodiscard]] std::optional<std::string> DrawSwitch(plan::EntryIndex entry, FigureFormat format);

 private:
  const plan::Plan& plan_;
  contour::ContourGraph graph_;
  contour::SetGeometry geometry_;
  std::vector<TrackEntry> track_;
  std::map<sets::SetIndex, int> names_;
  AxisUnit unit_;
};

}  // namespace regrasp::render
