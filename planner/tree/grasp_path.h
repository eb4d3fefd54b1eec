#pragma once

#include <optional>
#include <vector>

#include "planner/tree/face_align.h"

namespace regrasp::tree {

/// A step between two grasps of a SearchSpace: a finger switch, or an align where there is one.
struct PathStep {
  criteria::ContactSet to;
  std::optional<FaceAlign> align;
};

/// Grasps that follow each other.
struct GraspPath {
  criteria::ContactSet start;
  std::vector<PathStep> steps;

  [[nodiscard]] const criteria::ContactSet& end() const {
    return steps.empty() ? start : steps.back().to;
  }
};

/// The same align backwards.
[[nodiscard]] FaceAlign Reversed(FaceAlign align);

/// The same path backwards.
[[nodiscard]] GraspPath Reversed(const GraspPath& path);

/// Goes on with `more`, which begins where `path` ends.
void Append(const GraspPath& more, GraspPath& path);

}  // namespace regrasp::tree
