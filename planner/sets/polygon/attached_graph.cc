#include "planner/sets/polygon/attached_graph.h"

#include <limits>

#include "planner/search/fewest_switches.h"
#include "planner/search/widest_path.h"

namespace regrasp {

AttachedGraph::AttachedGraph(const PolygonGraph& graph, const std::vector<Attachment>& start,
                             const std::vector<Attachment>& goal,
                             const std::set<VertexPair>& banned)
    : graph_(graph),
      banned_(banned),
      start_(MakeEnd(this->start(), graph.vertex_count() + 2, start)),
      goal_(MakeEnd(this->goal(), graph.vertex_count() + 3, goal)) {}

AttachedGraph::End AttachedGraph::MakeEnd(int grasp, int changed,
                                          const std::vector<Attachment>& attachments) {
  End end = {grasp, changed, {}, {}};
  for (const Attachment& a : attachments) {
    (a.whole ? end.of_itself : end.by_switch).insert(a.vertex);
  }
  return end;
}

bool AttachedGraph::GetNeighboursOfEnd(const End& end, int vertex, std::vector<int>& neighbours) {
  if (vertex != end.grasp && vertex != end.changed) return false;
  const std::set<int>& sets = vertex == end.grasp ? end.of_itself : end.by_switch;
  neighbours.assign(sets.begin(), sets.end());
  if (!end.by_switch.empty()) neighbours.push_back(vertex == end.grasp ? end.changed : end.grasp);
  return true;
}

void AttachedGraph::AddEnd(const End& end, int set, std::vector<int>& neighbours) {
  if (end.of_itself.contains(set)) neighbours.push_back(end.grasp);
  if (end.by_switch.contains(set)) neighbours.push_back(end.changed);
}

void AttachedGraph::GetNeighbours(int vertex, std::vector<int>& neighbours) const {
  if (GetNeighboursOfEnd(start_, vertex, neighbours)) return;
  if (GetNeighboursOfEnd(goal_, vertex, neighbours)) return;
  graph_.GetNeighbours(vertex, neighbours);
  if (!banned_.empty()) {
    std::erase_if(neighbours,
                  [&](int other) { return banned_.contains(Unordered(vertex, other)); });
  }
  AddEnd(start_, vertex, neighbours);
  AddEnd(goal_, vertex, neighbours);
}

std::vector<int> FindSetPath(const AttachedGraph& graph, GraphCells& cells) {
  const VertexFilter all = [](int) { return true; };
  const auto switches = FewestSwitches(graph, graph.start(), graph.goal(), all);
  if (!switches) return {};
  std::vector<int> path =
      WidestPath(graph, graph.start(), graph.goal(), *switches, all, [&](int vertex) {
        return graph.IsSet(vertex) ? cells.WidthOf(vertex)
                                   : std::numeric_limits<double>::infinity();
      });
  std::erase_if(path, [&](int vertex) { return !graph.IsSet(vertex); });
  return path;
}

}  // namespace regrasp
