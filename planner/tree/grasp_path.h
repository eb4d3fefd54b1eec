#pragma once

#include <optional>
#include <vector>

#include "planner/tree/face_align.h"

namespace regrasp::tree {

/// Step between two grasps of a SearchSpace: a sliding step if `align` is set, otherwise a finger
/// switch.
struct PathStep {
  criteria::ContactSet to;
  std::optional<FaceAlign> align;
};

/// Sequence of grasps.
struct GraspPath {
  criteria::ContactSet start;
  std::vector<PathStep> steps;

  [[nodiscard]] const criteria::ContactSet& end() const {
    return steps.empty() ? start : steps.back().to;
  }
};

/// Return the reversed sliding step.
[[nodiscard]] FaceAlign Reversed(FaceAlign align);

/// Return the reversed path.
[[nodiscard]] GraspPath Reversed(const GraspPath& path);

/// Append `more`, which begins with the last grasp of `path`.
void Append(const GraspPath& more, GraspPath& path);

}  // namespace regrasp::tree
