#include "planner/grasp/edge_contact.h"

namespace regrasp::grasp {

Contact ContactAt(const object::Polygon& polygon, FaceIndex edge, double parameter) {
  const auto [a, b] = polygon.edge(edge);
  return {a + parameter * (b - a), polygon.inward_normal(edge), edge};
}

double ParameterOf(const object::Polygon& polygon, const Contact& contact) {
  const auto [a, b] = polygon.edge(contact.face);
  return (contact.p - a).dot(b - a) / (b - a).squaredNorm();
}

}  // namespace regrasp::grasp
