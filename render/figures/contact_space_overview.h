#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <span>
#include <string>

#include "planner/sets/contour/boundary.h"
#include "render/figures/contact_space_map.h"
#include "render/figures/contact_space_track.h"
#include "render/figures/figure_format.h"
#include "render/figures/figure_page.h"
#include "render/picture/color_table.h"

namespace regrasp::render {

/// The tint of a set that a plan uses, by the number of its name; six, then they repeat. Their
/// lightness differs, so that they stay apart in grey.
[[nodiscard]] Color PlanSetTint(int index);

/// The tint of any other set: greys, all lighter.
[[nodiscard]] Color OtherSetTint(sets::SetIndex set);

/// Widths of lines, points.
inline constexpr double kThinLine = 0.25;
inline constexpr double kSetBorder = 0.45;

/// Restricts what is drawn to a window, until cairo_restore.
void SaveAndClip(cairo_t* cr, const PlotWindow& window);

/// Fills outlines of one set as one area, without seams where they meet.
void FillPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces,
                Color color);

/// Hatches outlines: stretching grasps.
void HatchPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces,
                 Color color);

void StrokeSegments(cairo_t* cr, const PlotWindow& window, std::span<const Segment> segments,
                    Color color, double width);

/// Dashes of a switch, and dots of what only helps the eye, until ClearDash.
void SetDash(cairo_t* cr);
void SetDots(cairo_t* cr);
void ClearDash(cairo_t* cr);

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
