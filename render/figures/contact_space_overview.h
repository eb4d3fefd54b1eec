#pragma once

#include <string>

#include "planner/sets/contour/boundary.h"
#include "render/figures/contact_space_axis.h"
#include "render/figures/contact_space_map.h"
#include "render/figures/figure_format.h"

namespace regrasp::render {

/// Draws the contact space of the rings that a plan uses and the plan in it, as a file's bytes
/// (Phoka 2010, figures 4.3, 4.4 and 4.8).
///
/// The boundary length of one contact to the right, of the other one upwards, in `unit`;
/// both halves of the symmetric space. Sets of the plan are tinted and have their names at the
/// centres of their largest squares; other sets are grey; stretching grasps are hatched. Grasps at
/// rest are numbered dots (0 the initial one, k that after step k), aligns lines that break at the
/// frame, switches dashes along one axis. Several rings stand side by side, and their squares and
/// rectangles line up; a small ring has a scale of its own.
///
/// A column wide, two where there are several rings or many edges.
/// Laws: the same plan gives the same bytes.
/// @throws EnvironmentError  Cairo failed.
[[nodiscard]] std::string DrawContactSpace(const contour::Boundary& boundary,
                                           const ContactSpaceMap& map, const AxisUnit& unit,
                                           const std::string& caption, FigureFormat format);

}  // namespace regrasp::render
