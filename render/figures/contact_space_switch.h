#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/sets/contour/contour_graph.h"
#include "render/figures/contact_space_map.h"
#include "render/figures/contact_space_track.h"
#include "render/figures/figure_page.h"
#include "render/figures/panel_sheet.h"

namespace regrasp::render {

/// One of the two sets of a switch, unfolded: the boundary length of the contact that stays points
/// upwards, that of the second contact to the right.
struct ContactSwitchSide {
  int name = 0;  ///< index of the set's name (SetName)
  bool stretching = false;
  plan::EntryIndex grasp_entry{0};  ///< plan entry after which the plan has this grasp
  contour::RingIndex other_ring;
  UnfoldedSet set;
  Eigen::Vector2d grasp = Eigen::Vector2d::Zero();
  double size = 0;                 ///< half-width of the largest square around the grasp
  contour::PlaceRange projection;  ///< range of the set along the vertical axis
};

/// Content of the figure of a switch: both sets with a common vertical axis.
struct ContactSwitch {
  plan::EntryIndex entry{0};
  contour::RingIndex shared_ring;
  std::array<ContactSwitchSide, 2> sides;  ///< sets before and after the switch
  contour::PlaceRange
      overlap;  ///< intersection of the two projections, around the contact that stays
};

/// Compute the content of the figure of a switch.
/// @param entry  index of a switch in the track.
/// @returns nullopt if no contact stays, or if a grasp is on the border of force closure and in no
///          set.
[[nodiscard]] std::optional<ContactSwitch> DescribeContactSwitch(
    contour::SetGeometry& geometry, const std::vector<TrackEntry>& track, plan::EntryIndex entry,
    const std::map<sets::SetIndex, int>& names);

/// Positions of the two sets of a switch.
struct SwitchLayout {
  std::array<PlotWindow, 2> windows;
  double height = 0;  ///< height of the page without its caption, points
};

/// Lay out both sets with one scale for all axes, so that squares stay squares, and the same
/// vertical range. The scale is as large as two columns and the height of a page allow.
[[nodiscard]] SwitchLayout LayOutSwitch(const ContactSwitch& step);

/// Draw a switch in contact space, two columns wide (Phoka 2010, figures 4.6 and 4.9).
///
/// The figure shows
///   - the two unfolded sets with a common vertical axis for the contact that stays,
///   - bars of their projections onto this axis and of the intersection of these,
///   - the L-infinity Voronoi diagram of each set's border in thin lines,
///   - the two grasps with the largest squares around them, and
///   - the line through the contact that stays.
/// Deterministic.
/// @returns the bytes of the file.
/// @throws EnvironmentError  if Cairo fails.
[[nodiscard]] std::string DrawContactSwitch(const contour::Boundary& boundary,
                                            const ContactSwitch& step, const AxisUnit& unit,
                                            const std::string& caption, const FigureStyle& style);

}  // namespace regrasp::render
