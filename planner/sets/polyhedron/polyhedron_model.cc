#include "planner/sets/polyhedron/polyhedron_model.h"

namespace regrasp::polyhedron {

grasp::Grasp PolyhedronModel::Draw(int cell, RandomStream& random) {
  const auto place = geometry_.Draw(cell, random);
  return place ? GraspOf(*place) : grasp::Grasp();
}

std::vector<Attachment<FocusGrasp>> PolyhedronModel::Attach(
    const grasp::Grasp& grasp, const criteria::GraspEvaluator& /*evaluator*/) {
  std::vector<Attachment<FocusGrasp>> attachments;
  for (const FocusGrasp& place : geometry_.Locate(grasp)) attachments.push_back({place});
  return attachments;
}

std::string PolyhedronModel::WhyUnattached(const grasp::Grasp& /*grasp*/) const {
  if (graph().vertex_count() == 0) {
    return "four contacts on this body are nowhere concurrent at this friction, and the planner "
           "polyhedron plans between concurrent grasps only";
  }
  return "in none of the " + std::to_string(graph().vertex_count()) +
         " focus cells: its four contacts are not concurrent, as the planner polyhedron needs them";
}

std::optional<SetSwitch<FocusGrasp>> PolyhedronModel::FindSwitch(
    int from, int to, const SwitchEnds<Place>& ends,
    const criteria::GraspEvaluator& /*evaluator*/) {
  if (ends.before != nullptr && ends.after != nullptr) {
    return geometry_.FindSwitchBetween(*ends.before, *ends.after);
  }
  if (ends.before != nullptr) return geometry_.FindSwitchFrom(*ends.before, to);
  if (ends.after != nullptr) return geometry_.FindSwitchTo(from, *ends.after);
  return geometry_.FindSwitch(from, to);
}

std::vector<FocusGrasp> PolyhedronModel::FindRoute(const Place& from, const Place& to) {
  return geometry_.FindRoute(from, to);
}

}  // namespace regrasp::polyhedron
