#pragma once

#include <array>
#include <vector>

#include "planner/base/counted_progress.h"
#include "planner/sets/polygon/concurrent.h"
#include "planner/sets/polygon/parallel.h"
#include "planner/sets/polygon/two_finger.h"

namespace regrasp::polygon {

/// A set of grasps and the edges that it was found on.
template <class Candidate, class Component>
struct PolygonVertex {
  Candidate candidate;
  Component component;
};

/// The sets of grasps that are the vertices of a polygon's switching graph, of each type by their
/// edges, as exact predicates see them.
struct PolygonVertices {
  std::vector<PolygonVertex<ConcurrentCandidate, FocusComponent>> concurrent;
  std::vector<PolygonVertex<TwoFingerCandidate, TwoFingerPart>> two_finger;
  std::vector<PolygonVertex<ParallelCandidate, ParallelComponent>> parallel;
  std::array<GraspTypeCounts, kGraspTypes> counts;  ///< by GraspType, without components
};

/// Inside an IntervalScope. @param edges  outlives the result. @param tell  told how much is done.
/// @throws TimeUp  the deadline came.
[[nodiscard]] PolygonVertices FindVertices(const EdgeTable& edges, planning::Spanning spanning,
                                           const Deadline& deadline = {}, const Tell& tell = {});

}  // namespace regrasp::polygon
