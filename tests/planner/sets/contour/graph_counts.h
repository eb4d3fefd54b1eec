#pragma once

#include <cstdint>
#include <ostream>

#include "planner/base/number.h"
#include "planner/search/switching_graph.h"
#include "planner/sets/contour/contour_graph.h"

namespace regrasp::contour {

/// Counts of a contour graph.
struct Counts {
  std::int64_t candidates;
  std::int64_t combinations;
  std::int64_t vertices;
  std::int64_t switches;
  std::int64_t components;

  bool operator==(const Counts&) const = default;
};

inline void PrintTo(const Counts& c, std::ostream* out) {
  *out << "candidates " << c.candidates << ", combinations " << c.combinations << ", vertices "
       << c.vertices << ", switches " << c.switches << ", components " << c.components;
}

inline Counts CountsOf(const object::Polygon& polygon, double degrees) {
  const ContourGraph graph(polygon, Radians(degrees));
  return {graph.candidate_count(), graph.combination_count(), graph.vertex_count(),
          std::ssize(graph.switches()), graph.components().count()};
}

}  // namespace regrasp::contour
