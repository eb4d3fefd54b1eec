#pragma once

#include <string>

#include "planner/sets/contour/boundary.h"
#include "render/figures/contact_space_axis.h"
#include "render/figures/contact_space_switch.h"
#include "render/figures/figure_format.h"

namespace regrasp::render {

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
