#include "render/figures/contact_space_track.h"

#include <cassert>
#include <variant>

namespace regrasp::render {

namespace {

/// The contacts of a grasp on the axes that their fingers have.
AxisGrasp OnAxes(const plan::FingerGrasp& grasp, const AxisGrasp& axes) {
  assert(grasp.size() == 2);
  const bool turned = grasp[0].finger == axes[1].finger;
  return {grasp[turned ? 1 : 0], grasp[turned ? 0 : 1]};
}

void Follow(const plan::Align& step, const AxisGrasp& before, TrackEntry& entry) {
  for (const plan::FingerGrasp& waypoint : step.waypoints) {
    entry.path.push_back(OnAxes(waypoint, before));
  }
  entry.grasp = entry.path.back();
}

void Follow(const plan::Switch& step, const AxisGrasp& before, TrackEntry& entry) {
  const plan::FingerGrasp after = plan::GraspAfter({before[0], before[1]}, step);
  assert(after.size() == 2);
  entry.grasp = {after[0], after[1]};
  for (int axis = 0; axis < 2; ++axis) {
    if (plan::FindFinger(after, before[axis].finger) == nullptr) continue;
    entry.shared_axis = axis;
    const bool first = after[0].finger == before[axis].finger;
    entry.grasp[axis] = after[first ? 0 : 1];
    entry.grasp[1 - axis] = after[first ? 1 : 0];
    break;
  }
}

void Follow(const plan::Move& /*step*/, const AxisGrasp& before, TrackEntry& entry) {
  entry.grasp = before;
}

}  // namespace

std::optional<RestSize> FindOtherThanTwoFingers(const plan::Plan& plan) {
  plan::FingerGrasp grasp = plan.initial;
  plan::EntryIndex entry{0};
  for (const plan::Step& step : plan.steps) {
    if (grasp.size() != 2) break;
    grasp = plan::GraspAfter(grasp, step);
    ++entry;
  }
  if (grasp.size() == 2) return std::nullopt;
  return RestSize{entry, static_cast<int>(grasp.size())};
}

std::vector<TrackEntry> TrackPlan(const plan::Plan& plan) {
  assert(!FindOtherThanTwoFingers(plan));
  TrackEntry hold;
  hold.kind = "hold";
  hold.grasp = {plan.initial[0], plan.initial[1]};
  if (hold.grasp[0].contact.face > hold.grasp[1].contact.face) {
    std::swap(hold.grasp[0], hold.grasp[1]);
  }
  std::vector<TrackEntry> track = {hold};
  for (const plan::Step& step : plan.steps) {
    TrackEntry entry;
    entry.kind = plan::StepKind(step);
    std::visit([&](const auto& s) { Follow(s, track.back().grasp, entry); }, step);
    track.push_back(std::move(entry));
  }
  return track;
}

SpacePoint PointOf(const contour::Boundary& boundary, const AxisGrasp& grasp) {
  SpacePoint point;
  for (int axis = 0; axis < 2; ++axis) {
    point.rings[axis] = boundary.ring_of(grasp[axis].contact.face);
    point.places[axis] = boundary.PlaceOf(grasp[axis].contact);
  }
  return point;
}

}  // namespace regrasp::render
