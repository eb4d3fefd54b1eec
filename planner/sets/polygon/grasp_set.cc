#include "planner/sets/polygon/grasp_set.h"

namespace regrasp::polygon {

CommonEdges FindCommonEdges(std::span<const FaceIndex> a, std::span<const FaceIndex> b) {
  CommonEdges common;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) {
      common.emplace_back(static_cast<int>(i++), static_cast<int>(j++));
    } else {
      ++(a[i] < b[j] ? i : j);
    }
  }
  return common;
}

}  // namespace regrasp::polygon
