#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "planner/object/polygon.h"
#include "render/figures/grasp_diagram.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/plan_figure.h"

namespace regrasp::render {

/// Transformation from the plane of the object to a panel: object units to points, y up to y down.
struct PanelView {
  double width = 0;   ///< width of the panel, points
  double height = 0;  ///< height of the panel, points
  double scale = 1;   ///< scale, points per unit
  /// Point of the object at the centre of the panel.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();

  [[nodiscard]] Eigen::Vector2d ToPanel(const Eigen::Vector2d& p) const {
    return {width / 2 + scale * (p.x() - centre.x()), height / 2 - scale * (p.y() - centre.y())};
  }
  /// Return a direction on the panel, of the same length.
  [[nodiscard]] static Eigen::Vector2d ToPanelDirection(const Eigen::Vector2d& d) {
    return {d.x(), -d.y()};
  }
};

/// Space around the object for markers, arrows and numbers, points.
inline constexpr double kPanelMargin = 18;

/// Maximum distance of a visible focus point from the bounding box of the polygon, in diameters.
/// More distant ones would make the object too small.
inline constexpr double kFocusOnPage = 0.35;

/// Compute the common view of all panels of a plan.
///
/// The view contains the polygon and all focus points within kFocusOnPage. It is as large as
/// `width` points and a height of kTallestPanel times `width` allow, and no higher than necessary.
[[nodiscard]] PanelView FitView(const object::Polygon& polygon,
                                std::span<const StepDiagram> diagrams, double width);

inline constexpr double kTallestPanel = 1.25;

/// The path of a sliding finger on a panel, points.
struct PanelPath {
  std::vector<Eigen::Vector2d> points;  ///< polyline from the start to the contact
  struct Tick {
    Eigen::Vector2d at;
    Eigen::Vector2d across;  ///< unit vector along the tick
  };
  std::vector<Tick> ticks;
};

/// Compute a path at a distance outside the material, parallel to the border.
///
/// At a vertex the path follows the bisector of the two normals. In notches that are narrower than
/// the distance, points that would lead backwards are omitted. Ticks are waypoints, as far as they
/// are distinguishable in print.
/// @param distance  points.
[[nodiscard]] PanelPath PathBeside(std::span<const BorderPoint> path, const PanelView& view,
                                   double distance);

/// Minimum distance of ticks from each other and from the ends of the path, points.
inline constexpr double kPathTickGap = 6;

/// Return the drawn length of one side of a cone, points.
///
/// On the inner side it is a share of the diameter, limited by the panel. On the outer side it is
/// limited by the margin of the panel. In both cases it exceeds the distance to a focus point on
/// that side.
/// @param side  1 for the inner side, −1 for the outer one.
[[nodiscard]] double ConeLength(const object::Polygon& polygon, const GraspDiagram& grasp,
                                const DoubleCone& cone, int side, const PanelView& view);

/// Draw both sides of the cones of a grasp, translucent, in the colours of their fingers.
void DrawCones(cairo_t* cr, const object::Polygon& polygon, const StepDiagram& diagram,
               const PanelView& view);

/// Hatch the focus cell.
void DrawFocusCell(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

/// Draw the lines that characterize the type of a grasp: from the focus point to the contacts,
/// parallel lines of force, or a dashed line through two contacts.
void DrawForceLines(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

/// Mark the focus point.
void DrawFocusPoint(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view);

/// Draw the fingers as markers with numbers.
///
/// A placed finger has a ring and an arrow towards its contact, and a released finger is a hollow
/// marker with an arrow away from it. A sliding finger has a hollow marker at its start, and an
/// arrow along the border with a tick at each waypoint.
void DrawFingers(cairo_t* cr, const object::Polygon& polygon, const StepDiagram& diagram,
                 const PanelView& view);

/// Return the distance from a border point to the polygon along the outward normal; infinity if
/// there is no intersection.
[[nodiscard]] double OutwardClearance(const object::Polygon& polygon, const BorderPoint& from);

}  // namespace regrasp::render
