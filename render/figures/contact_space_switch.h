#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/figures/contact_space_track.h"
#include "render/figures/contact_space_unfolding.h"

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

}  // namespace regrasp::render
