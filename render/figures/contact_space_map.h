#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/sets/contour/set_geometry.h"
#include "render/figures/contact_space_track.h"

namespace regrasp::render {

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
