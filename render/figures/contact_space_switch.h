#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/sets/contour/boundary.h"
#include "render/figures/contact_space_map.h"
#include "render/figures/contact_space_track.h"
#include "render/figures/figure_format.h"
#include "render/figures/figure_page.h"

namespace regrasp::render {

/// One of the two sets of a switch, unfolded: the place of the contact that stays upwards, that of
/// the other one to the right.
struct ContactSwitchSide {
  int name = 0;  ///< of the set (SetName)
  bool stretching = false;
  plan::EntryIndex grasp_entry{0};  ///< of the plan: the grasp after it
  contour::RingIndex other_ring;
  UnfoldedSet set;
  Eigen::Vector2d grasp = Eigen::Vector2d::Zero();
  double size = 0;                 ///< half-width of the largest square about the grasp
  contour::PlaceRange projection;  ///< of the set, on the length of the contact that stays
};

/// What the figure of a switch shows: both sets with that length in line.
struct ContactSwitch {
  plan::EntryIndex entry{0};
  contour::RingIndex shared_ring;
  std::array<ContactSwitchSide, 2> sides;  ///< before and after
  contour::PlaceRange overlap;             ///< of the two projections, about the contact that stays
};

/// @param entry  of the track, a switch.
/// @returns nullopt where no contact stays, or a grasp lies in no set: at the very border of force
///          closure.
[[nodiscard]] std::optional<ContactSwitch> DescribeContactSwitch(
    contour::SetGeometry& geometry, const std::vector<TrackEntry>& track, plan::EntryIndex entry,
    const std::map<sets::SetIndex, int>& names);

/// Where a switch's two sets are drawn.
struct SwitchLayout {
  std::array<PlotWindow, 2> windows;
  double height = 0;  ///< of the page without its caption
};

/// One scale for both sets and both axes, so that squares are squares; the windows show the same
/// places upwards. As large as two columns and a page's height allow.
[[nodiscard]] SwitchLayout LayOutSwitch(const ContactSwitch& step);

/// Draws a switch in contact space, as a file's bytes, two columns wide (Phoka 2010, figures 4.6
/// and 4.9): the two sets unfolded, with the place of the contact that stays upwards, in line; bars
/// of their projections on it and of what these have in common; thin, the L-infinity Voronoi
/// diagram of each set's border; the two grasps with the largest squares about them; and the line
/// at the contact that stays.
///
/// Laws: the same plan gives the same bytes.
/// @throws EnvironmentError  Cairo failed.
[[nodiscard]] std::string DrawContactSwitch(const contour::Boundary& boundary,
                                            const ContactSwitch& step, const AxisUnit& unit,
                                            const std::string& caption, FigureFormat format);

}  // namespace regrasp::render
