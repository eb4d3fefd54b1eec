#include "planner/sets/contour/boundary.h"

#include <algorithm>

namespace regrasp::contour {

Boundary::Boundary(const object::Polygon& polygon) : polygon_(polygon) {
  int first = 0;
  for (std::size_t ring = 0; ring < polygon.rings().size(); ++ring) {
    const int count = static_cast<int>(polygon.rings()[ring].size());
    first_edges_.emplace_back(first);
    double place = 0;
    for (int k = 0; k < count; ++k) {
      ring_of_.emplace_back(static_cast<int>(ring));
      next_.emplace_back(first + (k + 1) % count);
      begins_.push_back(place);
      place += polygon.face_measure(FaceIndex(first + k));
      ends_.push_back(place);
    }
    perimeters_.push_back(place);
    first += count;
  }
  first_edges_.emplace_back(first);
}

double Boundary::PlaceOf(const grasp::Contact& contact) const {
  const auto [from, to] = polygon_.edge(contact.face);
  const double along = (contact.p - from).dot(to - from) / polygon_.face_measure(contact.face);
  return std::clamp(begin(contact.face) + along, begin(contact.face), end(contact.face));
}

grasp::Contact Boundary::ContactAt(FaceIndex edge, double place) const {
  const auto [from, to] = polygon_.edge(edge);
  // Divided by this difference, the end of an edge is bit-identical to its vertex.
  const double share = std::clamp((place - begin(edge)) / (end(edge) - begin(edge)), 0.0, 1.0);
  return {(1 - share) * from + share * to, polygon_.inward_normal(edge), edge};
}

}  // namespace regrasp::contour
