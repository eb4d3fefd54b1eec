#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/sets/contour/boundary.h"
#include "planner/sets/contour/contact_space.h"
#include "planner/sets/contour/set_geometry.h"
#include "render/figures/contact_space_track.h"

/// Cairo's, so that who names axes needs no Cairo.
using cairo_t = struct _cairo;

namespace regrasp::render {

/// A rectangle of contact space on a page: u to the right, u′ up.
struct PlotWindow {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< the places that it shows
  Eigen::Vector2d high = Eigen::Vector2d::Ones();
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< top left on the page, points
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();   ///< points per unit

  [[nodiscard]] Eigen::Vector2d ToPage(const Eigen::Vector2d& p) const {
    return corner + Eigen::Vector2d(scale.x() * (p.x() - low.x()), scale.y() * (high.y() - p.y()));
  }
  [[nodiscard]] Eigen::Vector2d size() const { return scale.cwiseProduct(high - low); }
};

/// A mark beside a plot: at a vertex of the polygon, or at a length with its label.
struct AxisTick {
  double place = 0;
  std::string label;  ///< empty: none
};

/// What the lengths on axes are told in.
struct AxisUnit {
  double per_unit = 1;    ///< so many in a unit of the boundary
  std::string name = {};  ///< "cm"; empty: none is told
};

/// The unit that suits the longest ring; the same for all axes of a plan.
/// @param metres_per_unit  of the boundary.
[[nodiscard]] AxisUnit UnitOfAxes(const contour::Boundary& boundary, double metres_per_unit);

/// The ticks of an axis, in ascending order: vertices of a ring, as many as print keeps apart, and
/// labels: the lengths of the vertices where these are few, otherwise round ones. Places beyond the
/// ring's end go around it and have the labels of the places they are; the end of an axis from zero
/// to the end has the perimeter.
/// @param points_per_unit  > 0.
/// @param label_gap        least distance of labels, points.
[[nodiscard]] std::vector<AxisTick> MakeTicks(const contour::Boundary& boundary,
                                              contour::RingIndex ring,
                                              const contour::PlaceRange& shown,
                                              double points_per_unit, double label_gap,
                                              const AxisUnit& unit = {});

/// Ticks nearer than this are not drawn apart, points.
inline constexpr double kTickGap = 1.6;

/// Space for ticks, labels and a title beside a plot, points.
inline constexpr double kLeftSpace = 44;
inline constexpr double kBottomSpace = 27;

/// "u (cm)", or where the polygon has holes "u, outer ring (cm)", "u, hole 1 (cm)".
[[nodiscard]] std::string AxisTitle(const contour::Boundary& boundary, const std::string& length,
                                    contour::RingIndex ring, const AxisUnit& unit = {});

/// Draw ticks, labels and a title (AxisTitle) below a plot, and to its left.
/// @param length  what the axis shows.
void DrawBottomAxis(cairo_t* cr, const contour::Boundary& boundary, contour::RingIndex ring,
                    const PlotWindow& window, const std::string& length, const AxisUnit& unit);
void DrawLeftAxis(cairo_t* cr, const contour::Boundary& boundary, contour::RingIndex ring,
                  const PlotWindow& window, const std::string& length, const AxisUnit& unit);

/// Draws the rectangle around a plot.
void DrawFrame(cairo_t* cr, const PlotWindow& window);

/// A path or an outline in contact space, all of it between one ring on the horizontal axis and one
/// on the vertical axis.
struct SpaceShape {
  std::array<contour::RingIndex, 2> rings = {};
  std::vector<Eigen::Vector2d> points;
};

/// A graspable set as the overview shows it: both halves of the space, the set and its mirror
/// image.
struct MapSet {
  sets::SetIndex set;
  bool stretching = false;
  std::optional<int> name;  ///< of a set of the plan
  std::vector<SpaceShape> pieces;
  std::vector<SpaceShape> border;        ///< of two points each
  std::vector<SpacePoint> label_places;  ///< centres of its largest squares, where it has a name
  double largest = 0;                    ///< half-width of these squares
};

struct MapSwitch {
  SpacePoint from;
  SpacePoint to;
  std::optional<int> shared_axis;
};

/// The whole contact space of the rings that a plan uses, and the plan in it.
struct ContactSpaceMap {
  std::vector<contour::RingIndex> rings;
  std::vector<MapSet> sets;       ///< those on these rings
  int set_count = 0;              ///< of the whole boundary
  std::vector<SpacePoint> rests;  ///< the grasp after each entry of the plan
  std::vector<SpaceShape> paths;  ///< of aligns, broken where a ring begins again
  std::vector<MapSwitch> switches;
};

/// The sets that a plan's grasps at rest lie in, in the order in which they come. Grasps in no set,
/// at the very border of force closure, have none.
[[nodiscard]] std::map<sets::SetIndex, int> NameSets(const contour::SetGeometry& geometry,
                                                     const std::vector<TrackEntry>& track);

/// The name of the k-th of them: "A", "B", … "Z", "AA" …
[[nodiscard]] std::string SetName(int k);

[[nodiscard]] ContactSpaceMap MapContactSpace(contour::SetGeometry& geometry,
                                              const std::vector<TrackEntry>& track);

}  // namespace regrasp::render
