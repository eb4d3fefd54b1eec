#include "planner/sets/contour/contour_model.h"

#include <algorithm>

#include "planner/sets/contour/align_route.h"

namespace regrasp::contour {

namespace {

/// Half-widths of regions in plans are smaller than computed by this share of them, and by this one
/// of the boundary's length: rounding.
constexpr double kRegionRounding = 1e-9;
constexpr double kBoundaryRounding = 1e-11;

}  // namespace

ContourModel::Attachments ContourModel::Attach(const grasp::Grasp& grasp) const {
  const auto place = geometry_.Locate(grasp);
  if (!place) return {};
  return {{graph().set_of(place->piece), *place}};
}

std::string ContourModel::WhyUnattached(const grasp::Grasp& /*grasp*/) const {
  return "too near to its limit: in none of the " + std::to_string(graph().vertex_count()) + " " +
         sets_name();
}

std::optional<ContourSwitch> ContourModel::FindSwitch(const Ends& ends) {
  const PlacedScore margin = [this](const Place& place) { return geometry_.AngleMarginOf(place); };
  if (ends.before != nullptr && ends.after != nullptr) {
    if (!HaveCommonContact(graph(), *ends.before, *ends.after)) return std::nullopt;
    return ContourSwitch{*ends.before, *ends.after};
  }
  if (ends.before != nullptr) {
    const auto after = FindGraspKeeping(geometry_, *ends.before, ends.to, margin);
    return after ? std::optional<ContourSwitch>({*ends.before, *after}) : std::nullopt;
  }
  if (ends.after != nullptr) {
    const auto before = FindGraspKeeping(geometry_, *ends.after, ends.from, margin);
    return before ? std::optional<ContourSwitch>({*before, *ends.after}) : std::nullopt;
  }
  auto best = FindMaxMarginSwitch(geometry_, ends.from, ends.to, margin);
  if (!best || IsGood(*best)) return best;
  return FindMaxMarginSwitch(geometry_, ends.from, ends.to,
                             [&](const Place& place) { return evaluator().Score(GraspOf(place)); });
}

std::optional<double> ContourModel::Refine(Switch& change) {
  if (objective_ == planning::Objective::kRegions) {
    const sets::SetIndex from = graph().set_of(change.before.piece);
    const sets::SetIndex to = graph().set_of(change.after.piece);
    const auto [known, is_new] = largest_.try_emplace({from, to});
    if (is_new) {
      known->second =
          FindLargestSwitch(geometry_, from, to, [&](const Switch& s) { return IsGood(s); });
    }
    const auto rank = [&](const Switch& s) { return std::pair(IsGood(s), RegionOf(s)); };
    if (known->second && rank(*known->second) > rank(change)) change = *known->second;
  }
  const double rounding = kBoundaryRounding * graph().boundary().perimeter(RingIndex(0));
  return std::max((1 - kRegionRounding) * RegionOf(change) - rounding, 0.0);
}

std::vector<PlacedGrasp> ContourModel::FindRoute(const Place& from, const Place& to) {
  return FindAlignRoute(geometry_, from, to);
}

double ContourModel::RegionOf(const Switch& change) {
  return std::min(geometry_.SizeAt(change.before), geometry_.SizeAt(change.after));
}

bool ContourModel::IsGood(const Switch& change) const {
  return evaluator().IsGood(GraspOf(change.before)) && evaluator().IsGood(GraspOf(change.after));
}

}  // namespace regrasp::contour
