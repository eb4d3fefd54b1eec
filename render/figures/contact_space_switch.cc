#include "render/figures/contact_space_switch.h"

#include <algorithm>
#include <limits>

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

std::optional<ContactSwitchSide> DescribeSide(contour::SetGeometry& geometry,
                                              const AxisGrasp& grasp, int shared_axis,
                                              const std::map<sets::SetIndex, int>& names) {
  const grasp::Contact& shared = grasp[shared_axis].contact;
  const grasp::Contact& other = grasp[1 - shared_axis].contact;
  const auto at = geometry.Locate({shared, other});
  if (!at) return std::nullopt;
  const contour::ContourGraph& graph = geometry.graph();
  const contour::GraspPiece& piece = graph.pieces()[at->piece];
  const int upright = piece.edges[0] == shared.face ? 0 : 1;
  ContactSwitchSide side;
  side.name = names.at(graph.set_of(at->piece));
  side.stretching = piece.stretching;
  side.other_ring = graph.boundary().ring_of(other.face);
  side.set = UnfoldSet(geometry, *at, upright);
  side.grasp = {at->places[1 - upright], at->places[upright]};
  side.size = geometry.SizeAt(*at);
  side.projection = {std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
  for (const Outline& outline : side.set.pieces) {
    for (const Vector2d& p : outline) {
      side.projection.low = std::min(side.projection.low, p.y());
      side.projection.high = std::max(side.projection.high, p.y());
    }
  }
  return side;
}

}  // namespace

std::optional<ContactSwitch> DescribeContactSwitch(contour::SetGeometry& geometry,
                                                   const std::vector<TrackEntry>& track,
                                                   plan::EntryIndex entry,
                                                   const std::map<sets::SetIndex, int>& names) {
  const auto axis = track[entry].shared_axis;
  if (!axis) return std::nullopt;
  ContactSwitch found;
  found.entry = entry;
  found.shared_ring = geometry.graph().boundary().ring_of(track[entry].grasp[*axis].contact.face);
  for (int k = 0; k < 2; ++k) {
    auto side = DescribeSide(geometry, track[entry - 1 + k].grasp, *axis, names);
    if (!side) return std::nullopt;
    side->grasp_entry = plan::EntryIndex(entry - 1 + k);
    found.sides[k] = std::move(*side);
  }
  const contour::PlaceRange& before = found.sides[0].projection;
  const contour::PlaceRange& after = found.sides[1].projection;
  found.overlap = {std::max(before.low, after.low), std::min(before.high, after.high)};
  return found;
}

}  // namespace regrasp::render
