#include "planner/polygon/boundary_draw.h"

#include <algorithm>

#include "planner/polygon/set_cells.h"

namespace regrasp {

Grasp DrawOnBoundary(const Polygon& polygon, int contacts, RandomStream& random) {
  double perimeter = 0;
  for (int e = 0; e < polygon.face_count(); ++e) perimeter += polygon.face_measure(e);
  Grasp grasp;
  while (static_cast<int>(grasp.size()) < contacts) {
    double along = random.Uniform() * perimeter;
    int edge = 0;
    while (edge + 1 < polygon.face_count() && along >= polygon.face_measure(edge)) {
      along -= polygon.face_measure(edge++);
    }
    grasp.push_back(ContactAt(polygon, edge, std::min(along / polygon.face_measure(edge), 1.0)));
  }
  return grasp;
}

std::optional<Grasp> DrawAnyGrasp(const Polygon& polygon, int least, int most,
                                  const GraspJudge& judge, RandomStream& random) {
  const int numbers = most - least + 1;
  const int first = static_cast<int>(random.Index(numbers));
  for (int i = 0; i < numbers; ++i) {
    const int contacts = least + (first + i) % numbers;
    auto grasp =
        DrawGoodGrasp([&] { return DrawOnBoundary(polygon, contacts, random); }, judge.frame(),
                      judge.half_angle(), judge.min_quality(), kSamePoint * polygon.diameter());
    if (grasp) return grasp;
  }
  return std::nullopt;
}

}  // namespace regrasp
