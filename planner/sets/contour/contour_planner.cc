#include "planner/sets/contour/contour_planner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <vector>

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/sets/contour/align_route.h"
#include "planner/sets/contour/grasp_pieces.h"
#include "planner/sets/contour/projection_sweep.h"
#include "planner/sets/graph_estimate.h"
#include "planner/sets/set_planner.h"

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

namespace {

/// Of the candidates; a share of a hundredth is then known to 10 %.
constexpr int kTestedCandidates = 10'000;

/// Counted in a tenth of a second. Pieces are joined to sets along neighbouring edges: of runs that
/// are this long the sets that go on beyond them count for less than the pieces.
constexpr int kEdgesOfRun = 20;
constexpr int kRuns = 20;

/// Measured on outlines of 300 to 10,000 edges at 2° to 40°, as the peak of resident memory: a
/// piece of a set with its passages and its places in the lists of sets; a switch with its two
/// entries in the lists of neighbours.
constexpr sets::GraphSize kBytes = {.candidates = 12, .sets = 80, .switches = 17};
/// The outline of a piece in contact space. Of 20 to 210 bytes for each piece of the graph, from a
/// given start and goal to ones that are drawn from one set of all pieces.
constexpr double kBytesOfOutline = 120;
/// The edges as exact predicates see them.
constexpr double kBytesOfEdge = 500;

std::vector<FaceIndex> DrawEdges(int count, RandomStream& random) {
  std::vector<FaceIndex> edges;
  if (count <= kRuns * kEdgesOfRun) {
    for (FaceIndex edge{0}; edge < count; ++edge) edges.push_back(edge);
    return edges;
  }
  for (const int run : random.Choose(count / kEdgesOfRun, kRuns)) {
    for (int i = 0; i < kEdgesOfRun; ++i) edges.emplace_back(run * kEdgesOfRun + i);
  }
  std::ranges::sort(edges);
  return edges;
}

/// Candidates and switches among some of the edges.
sets::GraphSize CountOn(const std::vector<FaceIndex>& drawn, const polygon::EdgeTable& edges,
                        const Boundary& boundary) {
  std::vector<polygon::TwoFingerCandidate> candidates =
      polygon::FindTwoFingerCandidates(edges.Of(drawn));
  for (auto& [a, b] : candidates) {
    a = drawn[a];
    b = drawn[b];
  }
  const std::vector<GraspPiece> pieces = FindPieces(edges, candidates);
  const std::vector<PiecePassage> passages = FindPassages(edges, boundary, pieces);
  const search::Components sets = FindSets(static_cast<int>(pieces.size()), passages);
  std::vector<std::vector<PieceIndex>> pieces_of(sets.count());
  for (PieceIndex piece{0}; piece < std::ssize(pieces); ++piece) {
    pieces_of[sets.of_vertex[piece]].push_back(piece);
  }
  const auto switches =
      FindOverlaps(edges, boundary, pieces, sets.count(),
                   [&](sets::SetIndex set) { return std::span<const PieceIndex>(pieces_of[set]); });
  return {.candidates = static_cast<double>(candidates.size()),
          .switches = static_cast<double>(switches.size())};
}

MemoryNeed Estimate(const object::Polygon& polygon, double half_angle,
                    const sets::GraphSize& bytes) {
  const double tangent = std::tan(half_angle);  // before the processor rounds upward
  const polygon::IntervalScope scope;
  const polygon::EdgeTable edges(polygon, tangent);
  RandomStream random(0, RandomUse::kCountedEdges);
  const polygon::CandidateSample sample =
      polygon::DrawTwoFingerCandidates(edges, kTestedCandidates, random);
  const auto candidates = static_cast<double>(sample.total);
  const double pieces =
      candidates * static_cast<double>(FindPieces(edges, sample.drawn).size()) / kTestedCandidates;
  const std::vector<FaceIndex> drawn = DrawEdges(polygon.face_count(), random);
  const sets::GraphSize counted = CountOn(drawn, edges, Boundary(polygon));
  const double count = polygon.face_count();
  // At a place of the boundary there are so many more sets, and so many more places.
  const double more_sets = counted.candidates > 0 ? candidates / counted.candidates : 0;
  const double more_places = static_cast<double>(drawn.size()) / count;
  const double switches = counted.switches * more_sets * more_sets * more_places;
  return sets::NeedOfGraph("contour", polygon, [=](double n) {
    const double squares = n * n / (count * count);
    const sets::GraphSize size = {squares * candidates, squares * pieces,
                                  squares * n / count * switches};
    return size.Times(bytes) + kBytesOfEdge * n;
  });
}

}  // namespace

MemoryNeed EstimateContourGraph(const object::Polygon& polygon, double half_angle) {
  return Estimate(polygon, half_angle, kBytes);
}

MemoryNeed EstimateContourPlan(const object::Polygon& polygon, double half_angle) {
  sets::GraphSize bytes = kBytes;
  bytes.sets += kBytesOfOutline;
  return Estimate(polygon, half_angle, bytes);
}

namespace {

const object::Polygon& PolygonOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polygon&>(*request.object);
}

ContourGraph BuildGraph(const planning::PlanRequest& request) {
  request.progress("building the switching graph");
  return ContourGraph(PolygonOf(request), request.criteria.half_angle, request.deadline,
                      request.progress);
}

}  // namespace

ContourPlanner::ContourPlanner()
    : planning::Planner({.name = "contour",
                         .what = "2-finger grasps of the whole boundary",
                         .in_plane = planning::PlannerScope{3, {2, 2}, {2, 2}},
                         .options = {planning::kRegionsOption}}) {}

std::optional<MemoryNeed> ContourPlanner::EstimateMemory(
    const planning::PlanRequest& request) const {
  // A graph alone takes less than planning on it.
  const auto estimate = request.for_graph ? EstimateContourGraph : EstimateContourPlan;
  return estimate(PolygonOf(request), request.criteria.half_angle);
}

planning::PlanResult ContourPlanner::Plan(const planning::PlanRequest& request) const {
  const ContourGraph graph = BuildGraph(request);
  ContourModel model(graph, request);
  return sets::PlanOverSets(model, request, name());
}

planning::GraphSummary ContourPlanner::SummarizeGraph(const planning::PlanRequest& request) const {
  const ContourGraph graph = BuildGraph(request);
  planning::GraphSummary summary = sets::SummaryOf(graph, *request.object, name());
  summary.edges = {{"two_finger-two_finger", std::ssize(graph.switches())}};
  summary.types = {{"two_finger", graph.candidate_count(), graph.combination_count(),
                    summary.vertices, summary.components}};
  return summary;
}

}  // namespace regrasp::contour
