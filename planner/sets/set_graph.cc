#include "planner/sets/set_graph.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

#include "planner/base/number.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::sets {

double SetGraph::CheckedTangent(double friction_angle) {
  if (friction_angle > 0 && friction_angle < std::numbers::pi / 2) return std::tan(friction_angle);
  throw std::invalid_argument("the friction angle must be in (0, pi/2)");
}

void SetGraph::BeginVertices() { stopwatch_ = {}; }

void SetGraph::EndVertices(int count) {
  neighbours_.resize(count);
  vertex_seconds_ = stopwatch_.Lap();
}

void SetGraph::EndEdges(std::vector<SetPair> switches, const std::vector<SetIndex>& all_joined) {
  switches_ = std::move(switches);
  all_joined_.assign(all_joined.begin(), all_joined.end());
  for (const auto& [a, b] : switches_) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }
  for (std::vector<int>& list : neighbours_) std::ranges::sort(list);
  edge_seconds_ = stopwatch_.Lap();
}

search::Components SetGraph::components() const {
  const int pairs = static_cast<int>(switches_.size());
  const int groups = pairs + (all_joined_.empty() ? 0 : 1);
  std::array<int, 2> pair;
  return search::FindComponents(vertex_count(), groups, [&](int group) {
    if (group >= pairs) return std::span<const int>(all_joined_);
    pair = {switches_[group][0], switches_[group][1]};
    return std::span<const int>(pair);
  });
}

void SetGraph::GetNeighbours(int vertex, std::vector<int>& neighbours) const {
  neighbours = neighbours_[vertex];
  if (!std::ranges::binary_search(all_joined_, vertex)) return;
  const auto middle = std::ssize(neighbours);
  std::ranges::copy_if(all_joined_, std::back_inserter(neighbours),
                       [&](int other) { return other != vertex; });
  std::inplace_merge(neighbours.begin(), neighbours.begin() + middle, neighbours.end());
}

bool AttachedGraph::IsOnlySetOfAnEnd(int vertex) const {
  const auto is_only = [set = SetIndex(vertex)](const GraspEnds& ends) {
    return ends.of_itself.size() + ends.by_switch.size() == 1 &&
           (ends.of_itself.contains(set) || ends.by_switch.contains(set));
  };
  return is_only(start_.sets) || is_only(goal_.sets);
}

bool AttachedGraph::GetNeighboursOfEnd(const End& end, int vertex, std::vector<int>& neighbours) {
  if (vertex != end.grasp && vertex != end.changed) return false;
  const std::set<SetIndex>& sets = vertex == end.grasp ? end.sets.of_itself : end.sets.by_switch;
  neighbours.assign(sets.begin(), sets.end());
  if (!end.sets.by_switch.empty()) {
    neighbours.push_back(vertex == end.grasp ? end.changed : end.grasp);
  }
  return true;
}

void AttachedGraph::AddEnd(const End& end, SetIndex set, std::vector<int>& neighbours) {
  if (end.sets.of_itself.contains(set)) neighbours.push_back(end.grasp);
  if (end.sets.by_switch.contains(set)) neighbours.push_back(end.changed);
}

void AttachedGraph::GetNeighbours(int vertex, std::vector<int>& neighbours) const {
  if (GetNeighboursOfEnd(start_, vertex, neighbours)) return;
  if (GetNeighboursOfEnd(goal_, vertex, neighbours)) return;
  graph_.GetNeighbours(vertex, neighbours);
  if (!banned_.empty()) {
    std::erase_if(neighbours,
                  [&](int other) { return banned_.contains(search::Unordered(vertex, other)); });
  }
  AddEnd(start_, SetIndex(vertex), neighbours);
  AddEnd(goal_, SetIndex(vertex), neighbours);
}

namespace {

/// Limits of the search for a random grasp: draws per set, and sets per pool.
constexpr int kDrawsPerSet = 30;
constexpr std::size_t kMaxSetDraws = 2000;

}  // namespace

double DrawNormal(RandomStream& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.Uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.Uniform());
}

SamplingPools StartPools(int set_count) {
  std::vector<SetIndex> all(set_count);
  std::iota(all.begin(), all.end(), SetIndex(0));
  return {all};
}

SamplingPools GoalPools(const search::Components& components,
                        const std::set<SetIndex>& start_sets) {
  std::set<int> reachable;
  for (const SetIndex set : start_sets) reachable.insert(components.of_vertex[set]);
  std::vector<SetIndex> others;
  for (SetIndex set{0}; set < static_cast<int>(components.of_vertex.size()); ++set) {
    if (reachable.contains(components.of_vertex[set]) && !start_sets.contains(set)) {
      others.push_back(set);
    }
  }
  return {others, {start_sets.begin(), start_sets.end()}};
}

grasp::Grasp DrawFromSets(const std::string& name, SamplingPools pools,
                          const std::function<grasp::Grasp(SetIndex set)>& draw,
                          const criteria::GraspEvaluator& evaluator, RandomStream& random) {
  std::size_t sets = 0;
  for (std::vector<SetIndex>& pool : pools) {
    sets += pool.size();
    const std::size_t draws = std::min(pool.size(), kMaxSetDraws);
    for (std::size_t i = 0; i < draws; ++i) {
      std::swap(pool[i], pool[i + random.Index(pool.size() - i)]);
      for (int k = 0; k < kDrawsPerSet; ++k) {
        grasp::Grasp grasp = draw(pool[i]);
        if (!grasp.empty() && evaluator.IsGood(grasp)) return grasp;
      }
    }
  }
  throw sampling::NoGrasp{name + ": no grasp" + criteria::WithWhatIsAsked(evaluator.criteria()) +
                          " was drawn from " + std::to_string(sets) + " sets of grasps" +
                          (pools.size() > 1 ? " in the start's component" : "")};
}

double JoinedGraph::BytesOf(GraphSize size, double n) const {
  size.switches = switches * size.sets * size.sets / std::pow(n, common_faces);
  return size.Times(bytes);
}

std::vector<FaceIndex> DrawFaces(const object::Object& object, int most, RandomStream random) {
  const int count = object.face_count();
  const std::vector<int> drawn = random.Choose(count, std::min(count, most));
  std::vector<FaceIndex> faces(drawn.begin(), drawn.end());
  std::ranges::sort(faces);
  return faces;
}

double ScaleUp(double counted, int faces, double m, double n) {
  for (int k = 0; k < faces; ++k) counted *= (n - k) / (m - k);
  return counted;
}

MemoryNeed NeedOfGraph(const std::string& planner, const object::Object& object,
                       std::function<double(double)> bytes_for) {
  return {"the graph of the planner " + planner, object.face_count(),
          object.dimension() == 2 ? "edges" : "faces", std::move(bytes_for)};
}

}  // namespace regrasp::sets
