#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "render/frames/ray_tree.h"

namespace regrasp::render {

using LineSegment = std::array<Eigen::Vector3d, 2>;

/// Parts of lines that a surface hides, and those that it does not.
struct LineParts {
  std::vector<LineSegment> visible;
  std::vector<LineSegment> hidden;
};

/// Cuts lines where they pass behind a surface, or come out, seen from far away.
///
/// Looks along each line in steps of kVisibilityStep, and finds the place of a change to within
/// 1e-5 of that: what is hidden or seen for less than a step may be missed. A surface that a line
/// lies on does not hide it. The surface is about 1 in size.
/// @param back  unit, towards the eye.
[[nodiscard]] LineParts SplitByVisibility(const RayTree& surface,
                                          std::span<const LineSegment> lines,
                                          const Eigen::Vector3d& back);

inline constexpr double kVisibilityStep = 0.01;

/// Whether a surface stands before a point.
[[nodiscard]] bool IsHidden(const RayTree& surface, const Eigen::Vector3d& point,
                            const Eigen::Vector3d& back);

}  // namespace regrasp::render
