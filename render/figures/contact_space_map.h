#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/sets/contour/contact_space.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/contour/set_geometry.h"
#include "render/figures/contact_space_track.h"
#include "render/picture/image.h"

/// Forward declaration of Cairo's type, so that users of axes do not include Cairo.
using cairo_t = struct _cairo;

namespace regrasp::render {

/// A rectangle of contact space on a page: u to the right, u′ up.
struct PlotWindow {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< visible range of boundary lengths
  Eigen::Vector2d high = Eigen::Vector2d::Ones();
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< top left corner on the page, points
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();   ///< scale along both axes, points per unit

  [[nodiscard]] Eigen::Vector2d ToPage(const Eigen::Vector2d& p) const {
    return corner + Eigen::Vector2d(scale.x() * (p.x() - low.x()), scale.y() * (high.y() - p.y()));
  }
  [[nodiscard]] Eigen::Vector2d size() const { return scale.cwiseProduct(high - low); }
};

/// A tick of an axis: at a vertex of the polygon, or at a length with its label.
struct AxisTick {
  double place = 0;
  std::string label;  ///< label; empty for none
};

/// The unit of lengths on axes.
struct AxisUnit {
  double per_unit = 1;    ///< number of these units per unit of the boundary
  std::string name = {};  ///< symbol, for example "cm"; empty for none
};

/// Return the unit that fits the longest ring, for all axes of a plan.
/// @param metres_per_unit  unit of the boundary, metres.
[[nodiscard]] AxisUnit UnitOfAxes(const contour::Boundary& boundary, double metres_per_unit);

/// Compute the ticks of an axis in ascending order.
///
/// Ticks are vertices of a ring, as far as they are distinguishable in print. Labels are the
/// lengths of the vertices if they are few, and round lengths otherwise. Positions beyond the end
/// of the ring continue at its start, with the labels of that. The end of an axis over exactly one
/// period is labelled with the perimeter.
/// @param shown            visible range of the axis.
/// @param points_per_unit  scale, > 0.
/// @param label_gap        minimum distance of labels, points.
[[nodiscard]] std::vector<AxisTick> MakeTicks(const contour::Boundary& boundary,
                                              contour::RingIndex ring,
                                              const contour::PlaceRange& shown,
                                              double points_per_unit, double label_gap,
                                              const AxisUnit& unit = {});

/// Minimum distance of ticks, points.
inline constexpr double kTickGap = 1.6;

/// Space for ticks, labels and a title next to a plot, points.
inline constexpr double kLeftSpace = 44;
inline constexpr double kBottomSpace = 27;

/// Return the title of an axis, for example "u (cm)". For a polygon with holes, "u, outer ring
/// (cm)" or "u, hole 1 (cm)".
[[nodiscard]] std::string AxisTitle(const contour::Boundary& boundary, const std::string& length,
                                    contour::RingIndex ring, const AxisUnit& unit = {});

/// Draw ticks, labels and title (AxisTitle) of the axis below or to the left of a plot.
/// @param length  quantity on the axis.
void DrawBottomAxis(cairo_t* cr, const contour::Boundary& boundary, contour::RingIndex ring,
                    const PlotWindow& window, const std::string& length, const AxisUnit& unit);
void DrawLeftAxis(cairo_t* cr, const contour::Boundary& boundary, contour::RingIndex ring,
                  const PlotWindow& window, const std::string& length, const AxisUnit& unit);

/// Draw the rectangle around a plot.
void DrawFrame(cairo_t* cr, const PlotWindow& window);

/// A path or an outline in contact space, between one ring on the horizontal and one on the
/// vertical axis.
struct SpaceShape {
  std::array<contour::RingIndex, 2> rings = {};
  std::vector<Eigen::Vector2d> points;
};

/// A graspable set in the overview, together with its mirror image in the other half of the space.
struct MapSet {
  sets::SetIndex set;
  bool stretching = false;
  std::optional<int> name;  ///< index of its displayed name; nullopt for sets not in the plan
  std::vector<SpaceShape> pieces;
  std::vector<SpaceShape> border;  ///< segments of two points each
  /// Centres of the largest squares; only for sets with a name.
  std::vector<SpacePoint> label_places;
  double largest = 0;  ///< half-width of these squares
};

struct MapSwitch {
  SpacePoint from;
  SpacePoint to;
  std::optional<int> shared_axis;
};

/// The contact space of the rings that a plan uses, and the plan in it.
struct ContactSpaceMap {
  std::vector<contour::RingIndex> rings;
  std::vector<MapSet> sets;        ///< sets on these rings
  int set_count = 0;               ///< number of sets of the whole boundary
  std::vector<SpacePoint> grasps;  ///< static grasp after each entry of the plan
  std::vector<SpaceShape> paths;   ///< paths of sliding steps, split at the ends of rings
  std::vector<MapSwitch> switches;
};

/// Number the sets that contain the static grasps of a plan, in plan order. Grasps on the border of
/// force closure are in no set.
[[nodiscard]] std::map<sets::SetIndex, int> NameSets(const contour::SetGeometry& geometry,
                                                     const std::vector<TrackEntry>& track);

/// Return the name of the k-th set of a plan: "A", "B", … "Z", "AA" …
[[nodiscard]] std::string SetName(int k);

[[nodiscard]] ContactSpaceMap MapContactSpace(contour::SetGeometry& geometry,
                                              const std::vector<TrackEntry>& track);

/// Return the colour of the k-th set of a plan. Six colours repeat. They differ in lightness, so
/// that they are distinguishable in greyscale.
[[nodiscard]] Color PlanSetTint(int index);

/// Return the grey of a set that the plan does not use. It is lighter than all colours of
/// PlanSetTint.
[[nodiscard]] Color OtherSetTint(sets::SetIndex set);

/// Line widths, points.
inline constexpr double kThinLine = 0.25;
inline constexpr double kSetBorder = 0.45;

/// Restrict drawing to a window until cairo_restore.
void SaveAndClip(cairo_t* cr, const PlotWindow& window);

/// Fill the outlines of a set as one area, without seams.
void FillPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces,
                Color color);

/// Hatch the outlines of stretching grasps.
void HatchPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces,
                 Color color);

void StrokeSegments(cairo_t* cr, const PlotWindow& window, std::span<const Segment> segments,
                    Color color, double width);

/// Set a dashed or dotted line style until ClearDash. Switches are dashed, auxiliary lines dotted.
void SetDash(cairo_t* cr);
void SetDots(cairo_t* cr);
void ClearDash(cairo_t* cr);

}  // namespace regrasp::render
