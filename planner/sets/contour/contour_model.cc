#include "planner/sets/contour/contour_model.h"

#include <algorithm>

#include "planner/sets/contour/align_route.h"

namespace regrasp::contour {

namespace {

/// Half-widths of regions in plans are smaller than computed by this share of them, and by this one
/// of the boundary's length: rounding.
constexpr double kRegionRounding = 1e-9;
constexpr double kBoundaryRounding = 1e-11;

std::optional<SetSwitch<PlacedGrasp>> EndsOf(const std::optional<ContourSwitch>& found) {
  if (!found) return std::nullopt;
  return SetSwitch<PlacedGrasp>{found->before, found->after};
}

}  // namespace

grasp::Grasp ContourModel::Draw(int set, RandomStream& random) {
  const auto place = geometry_.Draw(set, random);
  return place ? GraspOf(*place) : grasp::Grasp();
}

std::vector<Attachment<PlacedGrasp>> ContourModel::Attach(
    const grasp::Grasp& grasp, const criteria::GraspEvaluator& /*evaluator*/) const {
  const auto place = geometry_.Locate(grasp);
  if (!place) return {};
  return {{*place}};
}

std::string ContourModel::WhyUnattached(const grasp::Grasp& /*grasp*/) const {
  return "too near to its limit: in none of the " + std::to_string(graph().vertex_count()) + " " +
         sets_name();
}

std::optional<SetSwitch<PlacedGrasp>> ContourModel::FindSwitch(
    int from, int to, const SwitchEnds<Place>& ends, const criteria::GraspEvaluator& evaluator) {
  const PlacedScore margin = [this](const Place& place) { return geometry_.AngleMarginOf(place); };
  if (ends.before != nullptr && ends.after != nullptr) {
    return EndsOf(FindSwitchBetween(graph(), *ends.before, *ends.after));
  }
  if (ends.before != nullptr) return EndsOf(FindSwitchFrom(geometry_, *ends.before, to, margin));
  if (ends.after != nullptr) return EndsOf(FindSwitchTo(geometry_, from, *ends.after, margin));
  const auto deepest = EndsOf(FindMaxMarginSwitch(geometry_, from, to, margin));
  if (!deepest || IsGood(*deepest, evaluator)) return deepest;
  return EndsOf(FindMaxMarginSwitch(
      geometry_, from, to, [&](const Place& place) { return evaluator.Score(GraspOf(place)); }));
}

std::optional<double> ContourModel::Refine(SetSwitch<Place>& change,
                                           const criteria::GraspEvaluator& evaluator) {
  if (objective_ == planning::Objective::kRegions) {
    const int from = SetOf(change.before);
    const int to = SetOf(change.after);
    const auto [known, is_new] = largest_.try_emplace({from, to});
    if (is_new) {
      known->second =
          EndsOf(FindLargestSwitch(geometry_, from, to, [&](const ContourSwitch& candidate) {
            return IsGood({candidate.before, candidate.after}, evaluator);
          }));
    }
    const auto rank = [&](const SetSwitch<Place>& s) {
      return std::pair(IsGood(s, evaluator), RegionOf(s));
    };
    if (known->second && rank(*known->second) > rank(change)) change = *known->second;
  }
  const double rounding = kBoundaryRounding * graph().boundary().perimeter(0);
  return std::max((1 - kRegionRounding) * RegionOf(change) - rounding, 0.0);
}

std::vector<PlacedGrasp> ContourModel::FindRoute(const Place& from, const Place& to) {
  return FindAlignRoute(geometry_, from, to);
}

double ContourModel::RegionOf(const SetSwitch<Place>& change) {
  return std::min(geometry_.SizeAt(change.before), geometry_.SizeAt(change.after));
}

bool ContourModel::IsGood(const SetSwitch<Place>& change,
                          const criteria::GraspEvaluator& evaluator) const {
  return evaluator.IsGood(GraspOf(change.before)) && evaluator.IsGood(GraspOf(change.after));
}

}  // namespace regrasp::contour
