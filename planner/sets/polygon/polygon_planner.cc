#include "planner/sets/polygon/polygon_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/sets/candidate_search.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "planner/sets/sequence_builder.h"
#include "planner/sets/set_graph.h"
#include "planner/sets/set_parameters.h"
#include "planner/sets/set_planner.h"

namespace regrasp::polygon {

using Eigen::VectorXd;

namespace {

std::vector<bool> CellsWith(const SetCells& set, const VectorXd& parameters) {
  std::vector<bool> contain;
  for (const GraspCell& cell : set.cells()) {
    contain.push_back(SlackInCell(cell, parameters) > kNoSlack);
  }
  return contain;
}

}  // namespace

std::vector<VectorXd> FindAlignPath(const SetCells& set, const VectorXd& from, const VectorXd& to) {
  const auto passages = sets::FindPassages<VectorXd>(
      CellsWith(set, from), CellsWith(set, to),
      [&](sets::PieceIndex cell, sets::PieceIndex next) { return set.Passage(cell, next); });
  if (!passages) return {};
  std::vector<VectorXd> path = {from};
  path.insert(path.end(), passages->begin(), passages->end());
  path.push_back(to);
  return path;
}

namespace {

/// Number of edges on which vertices are counted, in a tenth of a second.
constexpr int kCountedEdges = 40;

/// Memory per element, measured as the peak of resident memory on polygons of 30 to 256 edges at
/// 10° to 30°. A set takes 4 to 12 kB, mainly for its possible contact pairs. A switch takes 8
/// bytes and two entries in lists of neighbours. The constant `switches` was 15 to 20.
constexpr sets::JoinedGraph kMeasured = {
    .bytes = {.candidates = 48, .sets = 7000, .switches = 28}, .common_faces = 2, .switches = 18};

/// Bytes per pair of edges, for the list of its sets.
constexpr double kBytesOfPair = 24;

}  // namespace

MemoryNeed EstimatePolygonGraph(const object::Polygon& polygon, double friction_angle,
                                planning::Spanning spanning) {
  const double tangent = std::tan(friction_angle);  // before the processor rounds upward
  const IntervalScope scope;
  const std::vector<FaceIndex> drawn =
      sets::DrawFaces(polygon, kCountedEdges, RandomStream(0, RandomUse::kCountedEdges));
  const auto counts = FindVertices(EdgeTable(polygon, tangent).Of(drawn), spanning).counts;
  const auto count = [&](GraspType type) { return counts[static_cast<int>(type)]; };
  const GraspTypeCounts concurrent = count(GraspType::kConcurrent);
  const GraspTypeCounts parallel = count(GraspType::kParallel);
  const auto candidates = static_cast<double>(concurrent.candidates + parallel.candidates);
  const auto on_three = static_cast<double>(concurrent.vertices + parallel.vertices);
  const auto on_two = static_cast<double>(count(GraspType::kTwoFinger).vertices);
  const double m = static_cast<double>(drawn.size());
  return sets::NeedOfGraph("polygon", polygon, [=](double n) {
    const double sets = sets::ScaleUp(on_two, 2, m, n) + sets::ScaleUp(on_three, 3, m, n);
    return kMeasured.BytesOf({sets::ScaleUp(candidates, 3, m, n), sets}, n) + kBytesOfPair * n * n;
  });
}

namespace {

/// Return the switch that keeps the most contacts, among those with at least kGoodShare of the best
/// score.
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
      // The sequence contains the grasp itself in any case, so its score does not matter.
      const double score =
          a.whole ? evaluator().friction_angle() : evaluator().Score(GraspOf(a.place));
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

/// Sets are open, so they contain no grasp with a contact at the end of an edge.
std::string PolygonModel::WhyUnattached(const grasp::Grasp& grasp) const {
  std::string why = "in none of the " + std::to_string(graph_.vertex_count()) +
                    " sets of concurrent, 2-finger and parallel grasps of the planner polygon, nor "
                    "one switch away from them";
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    const double to_corner = polygon_.DistanceToBorder(grasp[i].face, grasp[i].p);
    if (to_corner > kNoSlack * polygon_.diameter()) continue;
    return why + "; contact " + std::to_string(i) + " is at a corner, which is outside all sets";
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

namespace {

const object::Polygon& PolygonOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polygon&>(*request.object);
}

PolygonGraph BuildGraph(const planning::PlanRequest& request) {
  return PolygonGraph(PolygonOf(request), request.criteria.friction_angle,
                      sets::SpanningOf(request), request.deadline, request.progress);
}

std::string NameOf(GraspType type) {
  constexpr std::array kNames = {"concurrent", "two_finger", "parallel"};
  return kNames[static_cast<int>(type)];
}

/// Return the pairs of types that can switch, in the order of the graph file.
std::vector<std::pair<GraspType, GraspType>> JoinedTypes(planning::Spanning spanning) {
  using enum GraspType;
  std::vector<std::pair<GraspType, GraspType>> joined = {{kConcurrent, kConcurrent},
                                                         {kTwoFinger, kConcurrent},
                                                         {kParallel, kParallel},
                                                         {kTwoFinger, kParallel},
                                                         {kTwoFinger, kTwoFinger}};
  if (spanning == planning::Spanning::kAdaptive) joined.emplace_back(kConcurrent, kParallel);
  return joined;
}

}  // namespace

PolygonPlanner::PolygonPlanner()
    : planning::Planner(
          {.name = "polygon",
           .what = "concurrent, 2-finger and parallel grasps",
           .in_plane =
               planning::PlannerScope{hand::kFingersInPlane, {2, hand::kFingersInPlane}, {2, 3}},
           .options = {sets::kUniformSpanningOption}}) {}

std::optional<MemoryNeed> PolygonPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  return EstimatePolygonGraph(PolygonOf(request), request.criteria.friction_angle,
                              sets::SpanningOf(request));
}

planning::PlanResult PolygonPlanner::Plan(const planning::PlanRequest& request) const {
  const PolygonGraph graph = BuildGraph(request);
  PolygonModel model(PolygonOf(request), graph, request);
  return sets::PlanOverSets(model, request, name());
}

planning::GraphSummary PolygonPlanner::SummarizeGraph(const planning::PlanRequest& request) const {
  const PolygonGraph graph = BuildGraph(request);
  planning::GraphSummary summary = sets::SummaryOf(graph, *request.object, name());
  for (const auto type : {GraspType::kConcurrent, GraspType::kTwoFinger, GraspType::kParallel}) {
    const GraspTypeCounts& counts = graph.counts(type);
    summary.types.push_back(
        {NameOf(type), counts.candidates, counts.combinations, counts.vertices, counts.components});
  }
  for (const auto& [a, b] : JoinedTypes(sets::SpanningOf(request))) {
    summary.edges.emplace_back(NameOf(a) + "-" + NameOf(b), graph.edge_count(a, b));
  }
  return summary;
}

}  // namespace regrasp::polygon
