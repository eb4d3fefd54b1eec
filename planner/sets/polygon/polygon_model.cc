#include "planner/sets/polygon/polygon_model.h"

#include <algorithm>
#include <utility>

#include "planner/sets/polygon/align_path.h"
#include "planner/sets/sequence_builder.h"

namespace regrasp::polygon {

using Eigen::VectorXd;

namespace {

/// Of the switches with at least a good share of the best score, the one that keeps the most
/// contacts.
std::optional<SwitchPoint> BestOf(std::vector<SwitchPoint> points, const SwitchSide& from,
                                  const SwitchSide& to, const GraspScore& score) {
  std::vector<double> scores;
  for (const SwitchPoint& point : points) scores.push_back(ScoreOf(from, to, point, score));
  std::optional<std::size_t> best;
  const double highest = scores.empty() ? 0 : *std::max_element(scores.begin(), scores.end());
  const double least = highest > 0 ? sets::kGoodShare * highest : highest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (scores[i] < least) continue;
    const auto rank = [&](std::size_t k) { return std::pair(points[k].kept.size(), scores[k]); };
    if (!best || rank(i) > rank(*best)) best = i;
  }
  if (!best) return std::nullopt;
  return std::move(points[*best]);
}

}  // namespace

PolygonModel::Attachments PolygonModel::Attach(const grasp::Grasp& grasp) {
  using Scored = std::pair<double, sets::Attachment<Place>>;
  std::vector<Scored> scored;
  const auto add = [&](Attachments attachments) {
    for (sets::Attachment<Place>& a : attachments) {
      // The grasp itself is there anyway, good or not.
      const double score = a.whole ? evaluator().half_angle() : evaluator().Score(GraspOf(a.place));
      scored.emplace_back(score, std::move(a));
    }
  };
  const auto is_good = [](const Scored& s) { return s.first >= 0; };
  add(cells_.FindAttachments(grasp));
  if (std::ranges::none_of(scored, is_good)) add(cells_.FindSwitches(grasp, hand::kFingersInPlane));
  if (std::ranges::any_of(scored, is_good)) {
    std::erase_if(scored, [&](const Scored& s) { return !is_good(s); });
  }
  std::ranges::stable_sort(scored, std::ranges::greater(), &Scored::first);
  Attachments attachments;
  for (auto& [score, attachment] : scored) attachments.push_back(std::move(attachment));
  return attachments;
}

/// Sets are open: no grasp in them has a contact at the end of an edge.
std::string PolygonModel::WhyUnattached(const grasp::Grasp& grasp) const {
  std::string why = "in none of the " + std::to_string(graph_.vertex_count()) +
                    " sets of concurrent, 2-finger and parallel grasps that the planner polygon "
                    "switches between, nor one switch away";
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    const double to_corner = polygon_.DistanceToBorder(grasp[i].face, grasp[i].p);
    if (to_corner > kNoSlack * polygon_.diameter()) continue;
    return why + "; contact " + std::to_string(i) + " is at a corner, which none of them reaches";
  }
  return why;
}

std::optional<PolygonModel::Switch> PolygonModel::FindSwitch(const Ends& ends) {
  const auto side = [&](sets::SetIndex set, const Place* fixed) {
    return SwitchSide{&graph_.sets()[set], &cells_.of(set),
                      fixed == nullptr ? std::nullopt : std::optional(fixed->parameters)};
  };
  const SwitchSide a = side(ends.from, ends.before);
  const SwitchSide b = side(ends.to, ends.after);
  const GraspScore score = [&](const GraspSet& set, const VectorXd& parameters) {
    const sets::SetIndex number = &set == a.set ? ends.from : ends.to;
    return evaluator().Score(GraspOf({number, parameters}));
  };
  auto best = BestOf(FindSwitchPoints(a, b, hand::kFingersInPlane), a, b, score);
  if (!best) return std::nullopt;
  if (!a.fixed && !b.fixed) best = ImproveSwitch(a, b, *best, score);
  return Switch{{ends.from, best->before}, {ends.to, best->after}};
}

std::vector<PolygonPlace> PolygonModel::FindRoute(const Place& from, const Place& to) {
  std::vector<Place> route;
  for (VectorXd& parameters : FindAlignPath(cells_.of(from.set), from.parameters, to.parameters)) {
    route.push_back({from.set, std::move(parameters)});
  }
  return route;
}

}  // namespace regrasp::polygon
