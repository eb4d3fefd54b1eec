#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <span>

#include "render/figures/contact_space_axis.h"
#include "render/figures/contact_space_unfolding.h"
#include "render/picture/palette.h"

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

}  // namespace regrasp::render
