#include "planner/sets/attached_graph.h"

namespace regrasp::sets {

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

}  // namespace regrasp::sets
