#include "planner/sets/contour/contour_planner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <vector>

#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/sets/contour/grasp_pieces.h"
#include "planner/sets/contour/set_geometry.h"
#include "planner/sets/set_graph.h"
#include "planner/sets/set_planner.h"

namespace regrasp::contour {

namespace {

/// Reduction of regions' half-widths in plans because of rounding: fraction of the half-width, and
/// fraction of the boundary's length.
constexpr double kRegionRounding = 1e-9;
constexpr double kBoundaryRounding = 1e-11;

}  // namespace

ContourModel::Attachments ContourModel::Attach(const grasp::Grasp& grasp) const {
  const auto place = geometry_.Locate(grasp);
  if (!place) return {};
  return {{graph().set_of(place->piece), *place}};
}

std::string ContourModel::WhyUnattached(const grasp::Grasp& /*grasp*/) const {
  return "too close to the limit of force closure: in none of the " +
         std::to_string(graph().vertex_count()) + " " + sets_name();
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

/// Number of sampled candidates. A fraction of 1 % is then accurate to 10 %.
constexpr int kTestedCandidates = 10'000;

/// Edges on which pieces and switches are counted, in a tenth of a second. Pieces are connected to
/// sets along adjacent edges. In runs of this length, sets that continue beyond a run matter less
/// than the pieces.
constexpr int kEdgesOfRun = 20;
constexpr int kRuns = 20;

/// Bytes per element, measured as the peak of resident memory on outlines of 300 to 10,000 edges at
/// 2° to 40°. They include for a piece its passages and its entries in the lists of sets. They
/// include for a switch its two entries in the lists of neighbours.
constexpr sets::GraphSize kBytes = {.candidates = 12, .sets = 80, .switches = 17};
/// Bytes per piece of the graph for outlines in contact space. Measured: 20 for a given start and
/// goal, up to 210 for random ones from one set that contains all pieces.
constexpr double kBytesOfOutline = 120;
/// Bytes per edge in EdgeTable.
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

/// Count candidates and switches on some of the edges.
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

MemoryNeed Estimate(const object::Polygon& polygon, double friction_angle,
                    const sets::GraphSize& bytes) {
  const double tangent = std::tan(friction_angle);  // before the processor rounds upward
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
  // The number of sets is proportional to the candidates, that of switches to sets² / edges.
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

MemoryNeed EstimateContourGraph(const object::Polygon& polygon, double friction_angle) {
  return Estimate(polygon, friction_angle, kBytes);
}

MemoryNeed EstimateContourPlan(const object::Polygon& polygon, double friction_angle) {
  sets::GraphSize bytes = kBytes;
  bytes.sets += kBytesOfOutline;
  return Estimate(polygon, friction_angle, bytes);
}

namespace {

const object::Polygon& PolygonOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polygon&>(*request.object);
}

ContourGraph BuildGraph(const planning::PlanRequest& request) {
  request.progress("building the switching graph");
  return ContourGraph(PolygonOf(request), request.criteria.friction_angle, request.deadline,
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
  // Building a graph takes less memory than planning on it.
  const auto estimate = request.for_graph ? EstimateContourGraph : EstimateContourPlan;
  return estimate(PolygonOf(request), request.criteria.friction_angle);
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
