#include "planner/sets/graph_estimate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace regrasp::sets {

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
